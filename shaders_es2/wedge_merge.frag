// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The visibility that one batch of casters leaves, to be multiplied into that of the others.
#include "wedge_sums.glsl"
uniform HS_HIGHP sampler2D u_sums;
uniform HS_HIGHP vec4 u_wedgeSteps;
varying HS_HIGHP vec2 v_uv;
void main() {
  HS_HIGHP float covered = abs(hs_decodeCoverage(texture2D(u_sums, v_uv), u_wedgeSteps.x));
  gl_FragColor = vec4((floor((1.0 - clamp(covered, 0.0, 1.0)) * 255.0 + 0.5) + 0.125) / 255.0);
}
