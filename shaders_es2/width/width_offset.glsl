// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Offset to the nearest point of a silhouette, in texels of the width map, two bytes an axis: 128 + offset as
// whole texels and 1/256. The whole byte 0 means that no point is known.
HS_HIGHP vec4 hs_offsetBytes(HS_HIGHP vec4 stored) { return floor(stored * 255.0 + 0.5); }

bool hs_offsetKnown(HS_HIGHP vec4 bytes) { return bytes.x > 0.5; }

HS_HIGHP vec2 hs_offsetTexels(HS_HIGHP vec4 bytes) { return (bytes.xz - 128.0) + bytes.yw * (1.0 / 256.0); }

HS_HIGHP vec4 hs_packOffset(HS_HIGHP vec2 offset) {
  HS_HIGHP vec2 whole = floor(offset);
  HS_HIGHP vec2 part = floor((offset - whole) * 256.0);
  return (vec4(whole.x + 128.0, part.x, whole.y + 128.0, part.y) + 0.25) / 255.0;
}
