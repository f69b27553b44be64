// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Occupied share, and that share times normalised distance, over square boxes of the width map whose sides are powers
// of two: level l and level l + 1 in one fetch, from an atlas of tiles in columns of two.
uniform HS_HIGHP vec4 u_widthLayout;  // xy: texels per side of the image, zw: 1 / xy
uniform HS_HIGHP sampler2D u_boxes;
uniform HS_HIGHP vec4 u_boxLayout;  // xy: 1 / atlas size, z: last level of a tile, the first being 1

// Boxes of level l stand around their texel's centre plus this many texels (the doubling goes to and fro).
float hs_boxCenter(float level) {
  float sign = mod(level, 2.0) < 0.5 ? 1.0 : -1.0;
  return (1.0 - sign * exp2(level)) * (1.0 / 6.0);
}

// Side of the box whose variance that of a bilinear fetch of level l has, squared, in texels.
HS_HIGHP float hs_boxSideSquared(HS_HIGHP float level) { return exp2(2.0 * level) + 2.0; }

// `texel` of the map whose texels begin at `corner` of the image and are `size`.
HS_HIGHP vec4 hs_boxes(HS_HIGHP vec2 texel, float level, HS_HIGHP vec2 corner, HS_HIGHP vec2 size) {
  HS_HIGHP vec2 local = corner + clamp(texel - hs_boxCenter(level), vec2(0.5), size - 0.5);
  float index = level - 1.0;
  float row = floor(0.5 * index);
  HS_HIGHP vec2 origin = vec2(index - 2.0 * row, row) * u_widthLayout.xy;
  HS_COUNT(1);
  return texture2D(u_boxes, (origin + local) * u_boxLayout.xy);
}
