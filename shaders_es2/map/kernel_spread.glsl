// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Taps spread evenly over a rectangle of the map.
//
// side x side taps, side at most HS_SPREAD_KERNEL and chosen per fragment, in pairs mirrored at the receiver:
// that halves the loop, which costs more than its fetches on drivers that cannot unroll it.

// One tap in each square of a grid, off its middle by an amount of its row and one of its column, so that no edge
// crosses a whole row at once: visibility then changes by one tap at a time, not by `side` of them.
// place: squares from the middle of the grid along both axes; mirrored places get mirrored taps.
HS_HIGHP vec2 hs_spreadPlace(HS_HIGHP vec2 place) {
  // Multiples of the golden ratio lie evenly however many are taken.
  return place + fract(place.yx * 0.61803399 + 0.5) - 0.5;
}

// width: sides of the rectangle in texels.
float hs_spreadSum(HS_HIGHP vec2 width, HS_HIGHP float side, HS_HIGHP float bias) {
  HS_HIGHP vec2 stride = width / side;
  HS_HIGHP float last = 0.5 * (side - 1.0);
  HS_HIGHP vec2 place = vec2(-last);
  HS_HIGHP float pairs = floor(0.5 * side * side);
  HS_HIGHP float hasCenter = side * side - 2.0 * pairs;
  float lit = 0.0;
  if (hasCenter > 0.5) lit = hs_lit(hs_texel, hs_receiver, 0.0, bias);
  for (int i = 0; i < HS_SPREAD_KERNEL * HS_SPREAD_KERNEL / 2; ++i) {
    if (float(i) >= pairs) break;
    HS_HIGHP vec2 offset = hs_spreadPlace(place) * stride;
    HS_HIGHP float plane = dot(hs_gradient, offset);
    lit += hs_lit(hs_texel + offset, hs_receiver, plane, bias) +
           hs_lit(hs_texel - offset, hs_receiver, -plane, bias);
    place.x += 1.0;
    HS_HIGHP float wrapped = step(last + 0.5, place.x);
    place += wrapped * vec2(-side, 1.0);
  }
  return lit / (side * side);
}

// The same for HS_SPREAD_KERNEL taps a side, known to the compiler.
float hs_pcfSpread(HS_HIGHP vec2 width) {
  HS_HIGHP float bias = u_bias.x + u_bias.z * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP vec2 stride = width * (1.0 / float(HS_SPREAD_KERNEL));
  HS_HIGHP vec2 place = vec2(-0.5 * float(HS_SPREAD_KERNEL - 1));
  float lit = 0.0;
  for (int i = 0; i < HS_SPREAD_KERNEL * HS_SPREAD_KERNEL; ++i) {
    HS_HIGHP vec2 offset = hs_spreadPlace(place) * stride;
    lit += hs_lit(hs_texel + offset, hs_receiver, dot(hs_gradient, offset), bias);
    place.x += 1.0;
    HS_HIGHP float wrapped = step(0.5 * float(HS_SPREAD_KERNEL), place.x);
    place += wrapped * vec2(-float(HS_SPREAD_KERNEL), 1.0);
  }
  return lit * (1.0 / float(HS_SPREAD_KERNEL * HS_SPREAD_KERNEL));
}
