// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Moments as stored.
HS_HIGHP vec2 hs_unpackMoments(HS_HIGHP vec4 stored) {
#ifdef HS_MOMENTS_8
  return stored.rg;
#else
  HS_HIGHP vec4 bytes = floor(stored * 255.0 + 0.5);
  return vec2(bytes.r * 256.0 + bytes.g, bytes.b * 256.0 + bytes.a) * (1.0 / 65535.0);
#endif
}
vec4 hs_packMoments(HS_HIGHP vec2 moments) {
#ifdef HS_MOMENTS_8
  return vec4(moments, 0.0, 1.0);
#else
  HS_HIGHP vec2 scaled = floor(clamp(moments, 0.0, 1.0) * 65535.0 + 0.5);
  HS_HIGHP vec2 high = floor(scaled / 256.0);
  HS_HIGHP vec2 low = scaled - 256.0 * high;
  return (vec4(high.x, low.x, high.y, low.y) + 0.25) / 255.0;
#endif
}
