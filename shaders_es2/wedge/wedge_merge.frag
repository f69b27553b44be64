// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The visibility that one batch of casters leaves, to be multiplied into that of the others.
#include "wedge/wedge_sums.glsl"
uniform HS_HIGHP sampler2D u_sums;
uniform HS_HIGHP vec4 u_wedgeSteps;
varying HS_HIGHP vec2 v_uv;
void main() {
  gl_FragColor = hs_encodeRest(hs_decodeCoverage(texture2D(u_sums, v_uv), u_wedgeSteps.x));
}
