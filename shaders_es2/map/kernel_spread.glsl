// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Taps spread evenly over a rectangle of the map: side x side of them, side at most HS_SPREAD_KERNEL and chosen per
// fragment.
//
// Four taps a turn of the loop, a quarter turn about the receiver apart: a turn costs more than a fetch, and an edge
// along an axis crosses one tap at a time, not `side`. Turns step outward along one axis and by a share of the other
// that leaves no few of them close together: of 900 choices of share and start the best on straight edges of all
// directions and on corners, for 3 to 9 a side.

// width: sides of the rectangle in texels.
float hs_spreadSum(HS_HIGHP vec2 width, HS_HIGHP float side, HS_HIGHP float bias) {
  HS_HIGHP float count = side * side;
  HS_HIGHP float turns = floor(0.25 * count);
  HS_HIGHP float center = count - 4.0 * turns;
  // In widths. The tap in the middle, if there is one, takes half a step of each direction.
  HS_HIGHP float spacing = 1.0 / count;
  HS_HIGHP float range = 2.0 * spacing * turns;
  HS_HIGHP float end = range + 0.5 * center * spacing;
  HS_HIGHP vec2 place = vec2(0.5 * spacing, 0.31315 * range) + 0.5 * center * spacing;
  HS_HIGHP vec2 outward = vec2(2.0 * spacing, 0.6263 * range);
  HS_HIGHP vec2 gradient = hs_gradient * width;
  float lit = 0.0;
  if (center > 0.5) lit = hs_lit(hs_texel, hs_receiver, 0.0, bias);
  // More turns than 17 a side take, and more than compilers unroll: programs stay small.
  for (int i = 0; i < 96; ++i) {
    if (turns < 0.5) break;
    turns -= 1.0;
    HS_HIGHP vec2 offset = place * width;
    HS_HIGHP vec2 turned = vec2(-place.y, place.x) * width;
    HS_HIGHP float plane = gradient.x * place.x + gradient.y * place.y;
    HS_HIGHP float turnedPlane = gradient.y * place.x - gradient.x * place.y;
    lit += hs_lit(hs_texel + offset, hs_receiver, plane, bias) +
           hs_lit(hs_texel - offset, hs_receiver, -plane, bias) +
           hs_lit(hs_texel + turned, hs_receiver, turnedPlane, bias) +
           hs_lit(hs_texel - turned, hs_receiver, -turnedPlane, bias);
    place += outward;
    place.y -= step(end, place.y) * range;
  }
  return lit / count;
}

// The same for HS_SPREAD_KERNEL taps a side, or a texel a tap where that is less: more would read them again.
float hs_pcfSpread(HS_HIGHP vec2 width) {
  HS_HIGHP float bias = u_bias.x + u_bias.z * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP float side = min(floor(max(width.x, width.y)) + 2.0, float(HS_SPREAD_KERNEL));
  return hs_spreadSum(width, side, bias);
}
