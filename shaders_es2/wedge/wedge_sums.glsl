// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Sums of covered shares in one RGBA8 target that never clamp part-way: positive and negative steps apart, each
// as multiples of 16 (R, G) and a signed rest of at most 8 (B, A). All are whole bytes, so that blending adds
// them without rounding; a little above, for targets that truncate. Targets that keep fractions while they blend add
// these up, too, alike in both ways: no number of them makes one half, where rounding would tell R from G.
HS_HIGHP vec4 hs_encodeCoverage(HS_HIGHP float coverage, HS_HIGHP float steps) {
  HS_HIGHP float whole = floor(coverage * steps + 0.5);
  HS_HIGHP float high = floor(whole * (1.0 / 16.0) + 0.5);
  HS_HIGHP float low = whole - 16.0 * high;
  return (max(vec4(high, -high, low, -low), 0.0) + 0.12) * (1.0 / 255.0);
}
HS_HIGHP float hs_decodeCoverage(HS_HIGHP vec4 sums, HS_HIGHP float steps) {
  HS_HIGHP vec4 bytes = floor(sums * 255.0 + 0.5);
  return (16.0 * (bytes.x - bytes.y) + bytes.z - bytes.w) / steps;
}
// What is left of the light, as a byte to multiply by.
HS_HIGHP vec4 hs_encodeRest(HS_HIGHP float coverage) {
  return vec4((floor((1.0 - clamp(abs(coverage), 0.0, 1.0)) * 255.0 + 0.5) + 0.125) / 255.0);
}
// A piece's coverage: added to sums, or, of a caster that is one piece, multiplied into the visibility.
HS_HIGHP vec4 hs_encodePiece(HS_HIGHP float coverage, HS_HIGHP float steps) {
#ifdef HS_WEDGE_MULTIPLY
  return hs_encodeRest(coverage);
#else
  return hs_encodeCoverage(coverage, steps);
#endif
}
