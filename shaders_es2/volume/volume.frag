// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One value: a step of a count, or the visibility where a count is not zero.
#include "receiver/alpha_mask.glsl"
uniform HS_HIGHP vec4 u_color;
void main() {
  gl_FragColor = u_color;
  hs_cut();
}
