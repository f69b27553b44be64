// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Taps spread evenly over a rectangle of the map: side x side of them, side at most 17 and chosen per fragment. Needs
// spread_places.glsl and spread_taps.glsl.

// Sides of the narrowest kernel in texels. A receiver that is in the map itself may bend within a texel, and only a
// mean over one does not show its steps. Others are smooth: what a texel holds is then a better answer than a mean
// into its neighbours, which lets light in along the edge where walls meet (RMSE in the dark of a room .015 against .007).
#if defined(HS_CASTING_RECEIVER) || defined(HS_FORWARD)
#define HS_NARROWEST 1.0
#else
#define HS_NARROWEST 0.7
#endif

#ifndef HS_FEW_REGISTERS
// width: sides of the rectangle in texels.
float hs_spreadSum(HS_HIGHP vec2 width, HS_HIGHP float side, HS_HIGHP float bias) {
  HS_Places places = hs_firstPlaces(side);
  hs_beginTaps(width, bias);
  float lit = 0.0;
#ifdef HS_SHORT
  HS_HIGHP float count = places.turns + 0.5;
#else
  HS_HIGHP float count = side * side;
  if (places.center > 0.5) lit = hs_litTap(vec2(0.0), 0.0);
#endif
  for (int i = 0; i < HS_MOST_TURNS; ++i) {
    if (float(i) > places.turns) break;
#ifdef HS_SHORT
    lit += hs_litTap(places.place * hs_tapScale, dot(hs_tapGradient, places.place));
#else
    lit += hs_litTaps(places.place);
#endif
    hs_nextPlaces(places);
  }
  return lit / count;
}
#endif

// The same for HS_SPREAD_KERNEL taps a side, or a texel a tap where that is less: more would read them again.
float hs_pcfSpread(HS_HIGHP vec2 width) {
  HS_HIGHP float bias = hs_spreadBias();
  HS_HIGHP float side = min(floor(max(width.x, width.y)) + 2.0, float(HS_SPREAD_KERNEL));
  return hs_spreadSum(width, side, bias);
}
