// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One level of an N-buffer: the mean of four kernels of the level before, half as wide, side by side. Nothing
// lies outside the map.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceSize;  // x: texels per side, y: 1 / x
uniform HS_HIGHP vec4 u_place;       // x: samples per side, y: source texels per sample, z: source index at 0, w: step
#ifdef HS_TILED
// Several maps in rows; u_place counts in each.
uniform HS_HIGHP vec4 u_tiles;    // xy: columns and rows, zw: source texels of a map
uniform HS_HIGHP vec4 u_samples;  // xy: of a map, zw: of all
uniform HS_HIGHP vec2 u_sourceTexel;
#define hs_texel u_sourceTexel
#else
#define hs_texel u_sourceSize.y
#endif

void main() {
#ifdef HS_TILED
  HS_HIGHP vec2 place = floor(v_uv * u_samples.zw);
  HS_HIGHP vec2 tile = floor((place + 0.5) / u_samples.xy);
  HS_HIGHP vec2 index = (place - tile * u_samples.xy) * u_place.y + u_place.z;
  HS_HIGHP vec2 low = (tile * u_tiles.zw + 0.5) * hs_texel;
  HS_HIGHP vec2 high = low + (u_tiles.zw - 1.0) * hs_texel;
  HS_HIGHP vec2 first = low + index * hs_texel;
#define hs_source(at) texture2D(u_source, clamp(at, low, high))
#else
  HS_HIGHP vec2 first = (floor(v_uv * u_place.x) * u_place.y + u_place.z + 0.5) * hs_texel;
#define hs_source(at) texture2D(u_source, at)
#endif
#ifdef HS_FIRST_LEVEL
  // The map with its margin.
#ifdef HS_TILED
  HS_HIGHP vec2 inside = step(vec2(-0.25), index) * step(index, u_tiles.zw - 0.75);
#else
  HS_HIGHP vec2 inside = step(abs(first - 0.5), vec2(0.5));
#endif
  gl_FragColor = hs_source(first) * (inside.x * inside.y);
#else
  // Margins are empty as far as kernels reach, so that clamped fetches beyond them read nothing too.
  HS_HIGHP vec2 stride = vec2(u_place.w * hs_texel);
  gl_FragColor = 0.25 * (hs_source(first) + hs_source(first + stride) +
                         hs_source(first + vec2(stride.x, 0.0)) + hs_source(first + vec2(0.0, stride.y)));
#endif
}
