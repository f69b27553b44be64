// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Moments as stored, of distances along the light's axis rather than of depths: seen from a caster that stands beside
// the light, all others are at almost the same depth.
uniform HS_HIGHP vec4 u_momentRange;  // x: distance at 0, y: 1 / (distance at 1 - distance at 0), z: least variance, w: bias

// Beyond the near distance and in units of it, of depth 1 - near / distance.
HS_HIGHP float hs_momentDistance(HS_HIGHP float depth) { return depth / max(1.0 - depth, 1e-6); }
HS_HIGHP float hs_momentOf(HS_HIGHP float distance) {
  return clamp((distance - u_momentRange.x) * u_momentRange.y, 0.0, 1.0);
}
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
