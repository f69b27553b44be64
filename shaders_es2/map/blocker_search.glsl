// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Mean gap between the receiver and what blocks it, from taps over a rectangle of the map.
// Based on: Fernando, "Percentage-Closer Soft Shadows", 2005 (blocker search).
// Needs spread_places.glsl and spread_taps.glsl.

#ifndef HS_FEW_REGISTERS
// asked: sides in texels; side x side taps. Returns x: share of taps that block, y: mean distance in depth from blocker
// to receiver.
HS_HIGHP vec2 hs_searchTaps(HS_HIGHP vec2 asked, HS_HIGHP float side) {
  HS_Places places = hs_firstPlaces(side);
  hs_beginTaps(max(asked, vec2(1.0)), hs_spreadBias());
  HS_HIGHP vec2 found = vec2(0.0);
#ifdef HS_SHORT
  HS_HIGHP float count = places.turns + 0.5;
#else
  HS_HIGHP float count = side * side;
  if (places.center > 0.5) found = hs_blockingTap(vec2(0.0), 0.0);
#endif
  for (int i = 0; i < HS_MOST_TURNS; ++i) {
    if (float(i) > places.turns) break;
#ifdef HS_SHORT
    found += hs_blockingTap(places.place * hs_tapScale, dot(hs_tapGradient, places.place));
#else
    found += hs_blockingTaps(places.place);
#endif
    hs_nextPlaces(places);
  }
  return vec2(found.x / count, -found.y / max(found.x, 1.0));
}
#endif

// The same over what could hold blockers, and again over what the blockers found ask for as long as that is much less: a
// nearer caster at the rim makes the region wide without being in the way, and so does the upper part of a wall at
// whose foot the receiver lies. Where the light is wholly beyond such a wall, each search at least halves the gap
// until the region ends before the foot; regions wider than that let light in along it.
HS_HIGHP vec2 hs_searchBlockers() {
#ifdef HS_SHORT
  return hs_searchTaps(hs_kernel * hs_widestGap, float(HS_SEARCH));
#else
  HS_HIGHP float asked = hs_widestGap;
  HS_HIGHP vec2 found = vec2(0.0);
  // An end that compilers do not know: unrolled, the searches are more than many devices have room for.
  HS_HIGHP float last = 3.5 + min(u_map.x, 0.0);
  for (int i = 0; i < HS_MOST_TURNS; ++i) {
    HS_HIGHP vec2 nearer = hs_searchTaps(hs_kernel * asked, float(HS_SEARCH));
    if (nearer.x <= 0.0) break;
    found = nearer;
    if (found.y > 0.75 * asked || float(i) > last) break;
    asked = found.y;
  }
  return found;
#endif
}
