// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One piece's coverage of the receiver that the depth texture tells.
#include "screen/receiver_position.glsl"
#include "wedge/wedge_polygon.glsl"
#include "wedge/wedge_piece.glsl"
#include "wedge/wedge_sums.glsl"
uniform HS_HIGHP vec4 u_wedgeSteps;  // x: steps of full coverage, y: 1 where receivers of few triangles are not asked
void main() {
  HS_HIGHP vec4 stored = hs_storedReceiver();
  HS_HIGHP float coverage = hs_pieceCoverage(hs_positionOf(stored), hs_distanceOf(stored)) * (1.0 - u_wedgeSteps.y * hs_markOf(stored));
  gl_FragColor = hs_encodePiece(coverage, u_wedgeSteps.x);
}
