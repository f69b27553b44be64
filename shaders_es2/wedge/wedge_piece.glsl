// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The share of the light's square that one piece of silhouette covers, from the receiver's place. Needs
// wedge_polygon.glsl.
varying HS_HIGHP vec4 v_pieceA0;
varying HS_HIGHP vec4 v_pieceA1;
varying HS_HIGHP vec4 v_pieceB0;
varying HS_HIGHP vec4 v_pieceB1;
varying HS_HIGHP vec4 v_pieceH0;
varying HS_HIGHP vec4 v_pieceH1;
varying HS_HIGHP vec4 v_pieceCenter;  // w: the exponent of the caster's step
uniform HS_HIGHP vec4 u_pieceGrid;    // xyz: 1 / the units of a, b and h; w: a step over the caster's size
// x: unit of a over that of b; y: unit of b, in the caster's size; z: so much nearer than a receiver that its rounding
// does not tell, times its distance from the eye
uniform HS_HIGHP vec4 u_pieceScale;

// Without highp units are larger than steps, and mediump keeps fewer bits than interpolation spoils.
#ifdef HS_NO_HIGHP
HS_HIGHP vec4 hs_whole(HS_HIGHP vec4 units) { return units; }
#else
HS_HIGHP vec4 hs_whole(HS_HIGHP vec4 units) { return floor(units + 0.5); }
#endif

// Share of the light's square, signed by the way round; 0 where the other draw of the piece answers. `receiver` is
// (a, b, h - 1): near the casters it is small. `distance`: from the eye, as it is stored.
HS_HIGHP float hs_pieceCoverage(HS_HIGHP vec3 receiver, HS_HIGHP float distance) {
  // One number for all fragments: what interpolation adds to it would move the receiver.
  HS_HIGHP float inverseStep = exp2(-floor(v_pieceCenter.w + 0.5));
  HS_HIGHP vec3 fromCenter = receiver * u_pieceGrid.xyz * inverseStep - 64.0 * floor(v_pieceCenter.xyz + 0.5);
  // In the caster's size, so that thresholds are shares of it.
  HS_HIGHP vec4 w0 = (fromCenter.z - hs_whole(v_pieceH0)) * u_pieceGrid.w;
  HS_HIGHP vec4 w1 = (fromCenter.z - hs_whole(v_pieceH1)) * u_pieceGrid.w;
  HS_HIGHP float height = 1.0 + receiver.z;
  HS_HIGHP vec4 least = min(w0, w1);
  // Where a caster ends in a contour close to a receiver among its faces, a chord across it stands in: seen from much
  // closer than this, rounding of the receiver's place would turn it.
  HS_HIGHP float near = max(HS_WEDGE_NEAR, distance * u_pieceScale.z * u_pieceGrid.w * inverseStep);
  HS_HIGHP float allNear = step(max(HS_WEDGE_ALL_NEAR, 10.0 * near), min(min(least.x, least.y), min(least.z, least.w)));
#ifdef HS_WEDGE_CLIP
  allNear = 1.0 - allNear;
#endif
  // Behind the light there is no light to cover.
  return 0.25 * allNear * step(1e-6, height) *
         hs_polygonIntegral((hs_whole(v_pieceA0) - fromCenter.x) * u_pieceScale.x,
                            (hs_whole(v_pieceA1) - fromCenter.x) * u_pieceScale.x,
                            hs_whole(v_pieceB0) - fromCenter.y, hs_whole(v_pieceB1) - fromCenter.y, w0, w1,
                            receiver.xy, height * u_pieceScale.y, near);
}
