// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#define HS_BINARY_CLASS  // a class is 0 or 1 where no filter is needed
// The conservative mask: the smallest and the largest stored depth of a neighbourhood of blocks that covers
// every tap of the kernel. One fetch decides lit, umbra, or "the filter is needed".
uniform HS_HIGHP sampler2D u_blockMap;
// x: kernel radius in texels that the mask covers
uniform HS_HIGHP vec4 u_mask;

// 1: every tap is lit, 0: every tap is shadowed, -1: the filter decides. Exact: nothing is approximated, since
// both bounds are rounded outward and the comparisons are those of the taps with the worst plane offset.
float hs_maskClass() {
  HS_COUNT(1);
  // Fetched whether it is needed or not: inside an `if` it would cost some compilers a thread.
#ifdef HS_NO_HIGHP
  HS_HIGHP vec4 bounds = texture2DProj(u_blockMap, v_map);
#else
  HS_HIGHP vec4 bounds = texture2D(u_blockMap, hs_texel * u_map.y);
#endif
  HS_HIGHP float slope = abs(hs_gradient.x) + abs(hs_gradient.y);
  HS_HIGHP float bias = u_bias.x + u_bias.y * slope;
#ifdef HS_DEPTH_PACKED16
  HS_HIGHP float gapLow = hs_gap(bounds, hs_receiver);
  HS_HIGHP float gapHigh = hs_gap(bounds.baba, hs_receiver);
#else
  HS_HIGHP vec4 bytes = floor(bounds * 255.0 + 0.5);
  HS_HIGHP float gapLow = (bytes.r * 256.0 + bytes.g) * (1.0 / 65536.0) - hs_receiver;
  // The upper bound is stored as the next step above, so that 65536 steps stay 16 bits.
  HS_HIGHP float gapHigh = (bytes.b * 256.0 + bytes.a + 1.0) * (1.0 / 65536.0) - hs_receiver;
#endif
  float known = gapHigh < -bias - slope * u_mask.x ? 0.0 : -1.0;
  return gapLow >= -bias || hs_lightMisses ? 1.0 : known;
}

// Depth of the nearest caster that a kernel as wide as the mask can meet, depth units.
HS_HIGHP float hs_nearestAround() {
  HS_COUNT(1);
  HS_HIGHP vec4 bytes = floor(texture2D(u_blockMap, hs_texel * u_map.y) * 255.0 + 0.5);
#ifdef HS_DEPTH_PACKED16
  return bytes.r + bytes.g * (1.0 / 256.0);
#else
  return (bytes.r * 256.0 + bytes.g) * (1.0 / 65536.0);
#endif
}
