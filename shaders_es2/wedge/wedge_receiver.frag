// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One piece's coverage of the receiver that is drawn: its vertices come projected onto the light's plane.
#define HS_WEDGE_PROJECTED
#include "wedge/wedge_polygon.glsl"
#include "wedge/wedge_sums.glsl"
varying HS_HIGHP vec4 v_pieceX0;
varying HS_HIGHP vec4 v_pieceX1;
varying HS_HIGHP vec4 v_pieceY0;
varying HS_HIGHP vec4 v_pieceY1;
varying HS_HIGHP vec4 v_pieceW0;
varying HS_HIGHP vec4 v_pieceW1;
uniform HS_HIGHP vec4 u_wedgeSteps;  // x: steps of full coverage, y: least height that tells over distance from the eye
#if defined(HS_WEDGE_CLIP) && !defined(HS_WEDGE_EXACT)
varying HS_HIGHP float v_inverseSize;
#endif
#ifdef HS_WEDGE_EXACT
// Rasterisers snap vertices, some to a sixteenth of a pixel, and interpolate to match: a narrow penumbra shows that.
// The pixel's own ray meets the facet where it should.
varying HS_HIGHP vec4 v_place;
varying HS_HIGHP vec4 v_facet;
uniform HS_HIGHP vec4 u_receiverEye;
uniform HS_HIGHP vec4 u_receiverRay;
uniform HS_HIGHP vec4 u_receiverRayX;
uniform HS_HIGHP vec4 u_receiverRayY;

// From the interpolated place to the true one.
HS_HIGHP vec3 hs_moved() {
  HS_HIGHP vec3 ray = u_receiverRay.xyz + gl_FragCoord.x * u_receiverRayX.xyz + gl_FragCoord.y * u_receiverRayY.xyz;
  HS_HIGHP float across = dot(v_facet.xyz, ray);
  HS_HIGHP float along = (v_facet.w - dot(v_facet.xyz, u_receiverEye.xyz)) / (abs(across) < 1e-20 ? 1e-20 : across);
  HS_HIGHP vec3 moved = u_receiverEye.xyz + along * ray - v_place.xyz;
  // Not where the facet is seen edge-on.
  HS_HIGHP vec3 size = abs(v_place.xyz - u_receiverEye.xyz), change = abs(moved);
  return max(max(change.x, change.y), change.z) < 0.01 * max(max(size.x, size.y), size.z) ? moved : vec3(0.0);
}
#endif

void main() {
  HS_HIGHP vec4 x0 = v_pieceX0, x1 = v_pieceX1, y0 = v_pieceY0, y1 = v_pieceY1, w0 = v_pieceW0, w1 = v_pieceW1;
#ifdef HS_WEDGE_EXACT
  // With heights hP - w of the vertices, what a move of P adds to (hP E.ab - hE P.ab, hP - hE).
  HS_HIGHP vec3 moved = hs_moved();
  HS_HIGHP float height = max(1.0 + v_place.z, 1e-6);
  HS_HIGHP float share = moved.z / height;
  HS_HIGHP vec2 change = share * v_place.xy - moved.xy;
  HS_HIGHP vec4 h0 = height * v_place.w - w0, h1 = height * v_place.w - w1;
  x0 += share * x0 + change.x * h0;
  x1 += share * x1 + change.x * h1;
  y0 += share * y0 + change.y * h0;
  y1 += share * y1 + change.y * h1;
  w0 += moved.z * v_place.w;
  w1 += moved.z * v_place.w;
#endif
  HS_HIGHP float near = HS_WEDGE_NEAR;
#ifdef HS_WEDGE_CLIP
#ifdef HS_WEDGE_EXACT
  HS_HIGHP float inverseSize = v_place.w;
#else
  HS_HIGHP float inverseSize = v_inverseSize;
#endif
  near = max(near, u_wedgeSteps.y * inverseSize / gl_FragCoord.w);
#endif
  HS_HIGHP float integral = hs_polygonIntegral(x0, x1, y0, y1, w0, w1, vec2(0.0), 1.0, near);
  gl_FragColor = hs_encodePiece(0.25 * integral, u_wedgeSteps.x);
}
