// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// HS_SPREAD_KERNEL x HS_SPREAD_KERNEL taps spread evenly over a rectangle of the map.
// width: sides of the rectangle in texels.
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
