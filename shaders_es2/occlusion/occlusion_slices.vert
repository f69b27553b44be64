// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Casters as the slicing projection sees them; depth counts slice units.
#include "receiver/alpha_mask_vertex.glsl"
attribute highp vec3 a_position;
uniform highp mat4 u_clipFromObject;
varying highp vec2 v_slice;

void main() {
  hs_passSurface();
  gl_Position = u_clipFromObject * vec4(a_position, 1.0);
  v_slice = gl_Position.zw;
}
