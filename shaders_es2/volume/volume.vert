// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Receivers and shadow volumes alike: a cap shares its vertices with the receiver it lies on, so both must
// take one path to bitwise equal depths.
// w = 1: a point in object space; w = 0: a direction from the light along world axes, drawn at infinity.
#include "receiver/alpha_mask_vertex.glsl"
attribute highp vec4 a_position;
uniform highp mat4 u_clipFromObject;
uniform highp mat4 u_clipFromDirection;
invariant gl_Position;

void main() {
  hs_passSurface();
  highp vec4 near = u_clipFromObject * a_position;
  highp vec4 far = u_clipFromDirection * vec4(a_position.xyz, 0.0);
  // Just inside the far plane, which rounding of a product would not ensure.
  far.z = far.w * 0.999999;
  gl_Position = a_position.w > 0.5 ? near : far;
}
