// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One piece's coverage of the receiver that is drawn: its vertices come projected onto the light's plane.
#define HS_WEDGE_PROJECTED
#include "wedge_polygon.glsl"
#include "wedge_sums.glsl"
varying HS_HIGHP vec4 v_pieceX0;
varying HS_HIGHP vec4 v_pieceX1;
varying HS_HIGHP vec4 v_pieceY0;
varying HS_HIGHP vec4 v_pieceY1;
varying HS_HIGHP vec4 v_pieceW0;
varying HS_HIGHP vec4 v_pieceW1;
uniform HS_HIGHP vec4 u_wedgeSteps;  // x: steps of full coverage
void main() {
  HS_HIGHP float integral = hs_polygonIntegral(v_pieceX0, v_pieceX1, v_pieceY0, v_pieceY1, v_pieceW0, v_pieceW1,
                                               vec2(0.0), 1.0);
  gl_FragColor = hs_encodePiece(0.25 * integral, u_wedgeSteps.x);
}
