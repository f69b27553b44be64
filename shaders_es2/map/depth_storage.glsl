// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Reading stored depth on every rung, as a signed gap to a receiver.
//
// HS_Depth is a receiver's depth: a float in [0, 1] where fragments have highp, else two bytes (x high, y low).
// Gaps, gradients and biases are in depth units: 1 = the whole range with highp, 1/256 of it without, since a
// 16-bit step of the range would be a denormal in fp16.
#ifdef HS_DEPTH_PACKED16
#define HS_Depth vec2
float hs_gap(HS_HIGHP vec4 stored, HS_Depth receiver) {
  // The receiver's bytes are whole numbers: taken off before rounding.
  vec2 difference = floor(stored.rg * 255.0 + (0.5 - receiver));
  return difference.x + difference.y * (1.0 / 256.0);
}
float hs_depthValue(HS_HIGHP vec4 stored) {
  vec2 bytes = floor(stored.rg * 255.0 + 0.5);
  return bytes.x + bytes.y * (1.0 / 256.0);
}
#else
#define HS_Depth HS_HIGHP float
#ifdef HS_DEPTH_PACKED24
HS_HIGHP float hs_depthValue(HS_HIGHP vec4 stored) {
  HS_HIGHP vec3 bytes = floor(stored.rgb * 255.0 + 0.5);
  return dot(bytes, vec3(65536.0, 256.0, 1.0)) * (1.0 / 16777215.0);
}
#else
HS_HIGHP float hs_depthValue(HS_HIGHP vec4 stored) { return stored.r; }
#endif
HS_HIGHP float hs_gap(HS_HIGHP vec4 stored, HS_Depth receiver) { return hs_depthValue(stored) - receiver; }
#endif
