// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Places spread evenly over a rectangle: side x side of them, side chosen per fragment.
//
// Four places a turn of a loop, a quarter turn about the middle apart: a turn costs more than a fetch, and an edge
// along an axis crosses one place at a time, not `side`. Turns step outward along one axis and by a share of the
// other that leaves no few of them close together: of 900 choices of share and start the best on straight edges of all
// directions and on corners, for 3 to 9 a side.

// HS_SHORT: one place a turn and none in the middle, for devices that have no room for more.

// More turns than 17 a side take, and more than compilers unroll: programs stay small.
#ifdef HS_SHORT
#define HS_MOST_TURNS 384
#else
#define HS_MOST_TURNS 96
#endif

struct HS_Places {
  HS_HIGHP float turns;   // that they take, less a half
  HS_HIGHP float center;  // 1: the middle is a place as well
  HS_HIGHP vec2 place;    // of this turn, in sides of the rectangle from its middle; the others by quarter turns
  HS_HIGHP vec2 outward;  // to the next one
  HS_HIGHP vec2 wrap;     // x: end of the second axis, y: length
#ifdef HS_SHORT
  HS_HIGHP float quarter;  // of the four, the turn's
#endif
};

HS_Places hs_firstPlaces(HS_HIGHP float side) {
  // Compilers unroll loops whose end they know: that is more than many devices have room for.
  side += min(u_map.x, 0.0);
  HS_Places places;
  HS_HIGHP float spacing = 1.0 / (side * side);
  HS_HIGHP float turns = floor(0.25 * side * side);
  places.center = side * side - 4.0 * turns;
  // The place in the middle takes half a step of each direction.
  HS_HIGHP float first = 0.5 * places.center * spacing;
  HS_HIGHP float range = 2.0 * spacing * turns;
  places.place = first + vec2(0.5 * spacing, 0.31315 * range);
  places.outward = vec2(2.0 * spacing, 0.6263 * range);
  places.wrap = vec2(first + range, range);
#ifdef HS_SHORT
  turns *= 4.0;
  places.quarter = 0.0;
#endif
  places.turns = turns - 0.5;
  return places;
}

void hs_nextPlaces(inout HS_Places places) {
#ifdef HS_SHORT
  places.quarter += 1.0;
  HS_HIGHP float outward = step(3.5, places.quarter);
  places.quarter -= 4.0 * outward;
  places.place = vec2(-places.place.y, places.place.x) + outward * places.outward;
  places.place.y -= outward * step(places.wrap.x, places.place.y) * places.wrap.y;
#else
  places.place += places.outward;
  places.place.y -= step(places.wrap.x, places.place.y) * places.wrap.y;
#endif
}
