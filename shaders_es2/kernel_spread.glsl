// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Taps spread evenly over a rectangle of the map.
//
// side x side taps, side at most HS_SPREAD_KERNEL and chosen per fragment, in pairs mirrored at the receiver:
// that halves the loop, which costs more than its fetches on drivers that cannot unroll it.
// width: sides of the rectangle in texels.
float hs_spreadSum(HS_HIGHP vec2 width, HS_HIGHP float side, HS_HIGHP float bias) {
  HS_HIGHP vec2 stride = width / side;
  HS_HIGHP vec2 first = 0.5 * (stride - width);
  HS_HIGHP vec2 offset = first;
  HS_HIGHP float pairs = floor(0.5 * side * side);
  HS_HIGHP float hasCenter = side * side - 2.0 * pairs;
  float column = 0.0;
  float lit = 0.0;
  if (hasCenter > 0.5) lit = hs_lit(hs_texel * u_map.y, hs_receiver, 0.0, bias);
  for (int i = 0; i < HS_SPREAD_KERNEL * HS_SPREAD_KERNEL / 2; ++i) {
    if (float(i) >= pairs) break;
    HS_HIGHP float plane = dot(hs_gradient, offset);
    lit += hs_lit((hs_texel + offset) * u_map.y, hs_receiver, plane, bias) +
           hs_lit((hs_texel - offset) * u_map.y, hs_receiver, -plane, bias);
    column += 1.0;
    float wrapped = step(side - 0.5, column);
    column -= wrapped * side;
    offset.x = first.x + column * stride.x;
    offset.y += wrapped * stride.y;
  }
  return lit / (side * side);
}

// The same for HS_SPREAD_KERNEL taps a side, known to the compiler.
float hs_pcfSpread(HS_HIGHP vec2 width) {
  HS_HIGHP float bias = u_bias.x + u_bias.z * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP vec2 stride = width * (1.0 / float(HS_SPREAD_KERNEL));
  HS_HIGHP vec2 first = 0.5 * (stride - width);
  HS_HIGHP vec2 offset = first;
  float column = 0.0;
  float lit = 0.0;
  for (int i = 0; i < HS_SPREAD_KERNEL * HS_SPREAD_KERNEL; ++i) {
    lit += hs_lit((hs_texel + offset) * u_map.y, hs_receiver, dot(hs_gradient, offset), bias);
    column += 1.0;
    float wrapped = step(float(HS_SPREAD_KERNEL) - 0.5, column);
    column -= wrapped * float(HS_SPREAD_KERNEL);
    offset.x = first.x + column * stride.x;
    offset.y += wrapped * stride.y;
  }
  return lit * (1.0 / float(HS_SPREAD_KERNEL * HS_SPREAD_KERNEL));
}
