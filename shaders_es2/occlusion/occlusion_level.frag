// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One level of an N-buffer: the mean of four kernels of the level before, half as wide, side by side. Nothing
// lies outside the map.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceSize;  // x: texels per side, y: 1 / x
uniform HS_HIGHP vec4 u_place;       // x: samples per side, y: source texels per sample, z: source index at 0, w: step
#ifdef HS_TILED
// Several maps in rows of a square; u_place counts in each.
uniform HS_HIGHP vec4 u_tiles;  // x: maps in a row, y: source texels per side of one
#endif

void main() {
#ifdef HS_TILED
  HS_HIGHP vec2 place = floor(v_uv * (u_place.x * u_tiles.x));
  HS_HIGHP vec2 tile = floor((place + 0.5) / u_place.x);
  HS_HIGHP vec2 index = (place - tile * u_place.x) * u_place.y + u_place.z;
  HS_HIGHP vec2 low = (tile * u_tiles.y + 0.5) * u_sourceSize.y;
  HS_HIGHP vec2 high = low + (u_tiles.y - 1.0) * u_sourceSize.y;
  HS_HIGHP vec2 first = low + index * u_sourceSize.y;
#define hs_source(at) texture2D(u_source, clamp(at, low, high))
#else
  HS_HIGHP vec2 first = (floor(v_uv * u_place.x) * u_place.y + u_place.z + 0.5) * u_sourceSize.y;
#define hs_source(at) texture2D(u_source, at)
#endif
#ifdef HS_FIRST_LEVEL
  // The map with its margin.
#ifdef HS_TILED
  HS_HIGHP vec2 inside = step(vec2(-0.25), index) * step(index, vec2(u_tiles.y - 0.75));
#else
  HS_HIGHP vec2 inside = step(abs(first - 0.5), vec2(0.5));
#endif
  gl_FragColor = hs_source(first) * (inside.x * inside.y);
#else
  // Margins are empty as far as kernels reach, so that clamped fetches beyond them read nothing too.
  HS_HIGHP float stride = u_place.w * u_sourceSize.y;
  gl_FragColor = 0.25 * (hs_source(first) + hs_source(first + stride) +
                         hs_source(first + vec2(stride, 0.0)) + hs_source(first + vec2(0.0, stride)));
#endif
}
