// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// x: occupied share, y: mean normalised depth of what occupies, both in [0, 1], as 16 bits each in RGBA8.

// Stored a quarter above the step, so that targets which round and targets which truncate keep all bits.
vec4 hs_packOccupancy(HS_HIGHP vec2 occupancy) {
  HS_HIGHP vec2 scaled = clamp(occupancy, 0.0, 1.0) * 255.0;
  HS_HIGHP vec2 high = floor(scaled);
  HS_HIGHP vec2 low = min(floor((scaled - high) * 256.0), 255.0);
  return (vec4(high.x, low.x, high.y, low.y) + 0.25) / 255.0;
}

// In steps of 1/255.
HS_HIGHP vec2 hs_unpackOccupancy(HS_HIGHP vec4 stored) {
#ifdef HS_NO_HIGHP
  HS_HIGHP vec4 bytes = floor(stored * 255.0 + 0.5);
#else
  HS_HIGHP vec4 bytes = stored * 255.0;  // whole to a part of a low byte
#endif
  return bytes.rb + bytes.ga * (1.0 / 256.0);
}
