// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One piece's coverage: added to sums, or, of a caster that is one piece, multiplied into the visibility.
#include "receiver_position.glsl"
#include "wedge_piece.glsl"
#include "wedge_sums.glsl"
uniform HS_HIGHP vec4 u_wedgeSteps;  // x: steps of full coverage
void main() {
  HS_HIGHP float coverage = hs_pieceCoverage(hs_receiverPosition());
#ifdef HS_WEDGE_MULTIPLY
  gl_FragColor = vec4((floor((1.0 - clamp(abs(coverage), 0.0, 1.0)) * 255.0 + 0.5) + 0.125) / 255.0);
#else
  gl_FragColor = hs_encodeCoverage(coverage, u_wedgeSteps.x);
#endif
}
