// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Means of an occlusion texture's channels over a rectangle of the map: the light's frustum. Channels are named by
// column and row: red (0, 0), green (1, 0), blue (0, 1), alpha (1, 1); pairs by their row.
// HS_FILTER_NBUFFER and HS_FILTER_MIPMAP: x: side of all maps in texels, yz: 1 / atlas size, w: last level;
// HS_FILTER_SAT: x: the same, y: 1 / side of the sums' texture, z: 256 / count of a full texel.
uniform HS_HIGHP vec4 u_occlusionLayout;
// xy: sides of the kernel over its longer one; HS_BOXES > 1: z: side of one of the boxes that make up the kernel
uniform HS_HIGHP vec4 u_kernelShape;
#ifdef HS_SUB_LIGHTS_U
// Maps of HS_SUB_LIGHTS_U x HS_SUB_LIGHTS_V sub-lights stand in rows.
uniform HS_HIGHP vec4 u_tiles;  // xy: columns and rows, zw: texels of a map
HS_HIGHP vec2 hs_tile;          // whose map is read: column and row
#define hs_mapTexels u_tiles.zw
#else
#define hs_mapTexels vec2(u_occlusionLayout.x)
#endif

#if defined(HS_FILTER_NBUFFER)
// Levels 0 to 3 at full resolution in a square of four, then samples at an eighth of the kernel's side in a
// column; five samples of margin around each. Level 0 lies at texel centres, the means of the others where their texels
// meet.
#ifdef HS_NO_HIGHP
// Where to read a level. One after the other: both at once take twice the registers.
HS_HIGHP vec2 hs_levelPlace(HS_HIGHP vec2 texel, float level) {
  float coarse = max(level - 3.0, 0.0);
  HS_HIGHP float perSample = exp2(-coarse);
  float row = step(1.5, level), column = step(3.5, level);
#ifdef HS_SUB_LIGHTS_U
  HS_HIGHP vec2 full = u_tiles.zw + 11.0;
  HS_HIGHP vec2 side = ceil(u_tiles.zw * perSample) + 11.0;
  HS_HIGHP float far = u_tiles.w - ceil(u_tiles.w * 2.0 * perSample) + 13.0 * (coarse - 1.0);
#else
  HS_HIGHP vec2 full = vec2(u_occlusionLayout.x + 11.0);
  HS_HIGHP vec2 side = vec2(u_occlusionLayout.x * perSample + 11.0);
  HS_HIGHP float far = u_occlusionLayout.x - 2.0 * side.x + 11.0 * coarse + 11.0;
#endif
  HS_HIGHP float originX = mix((level - 2.0 * row) * full.x, 2.0 * full.x, column);
  HS_HIGHP float originY = mix(row * full.y, far, column);
  HS_HIGHP vec2 origin = vec2(originX, originY);
#ifdef HS_SUB_LIGHTS_U
  origin = origin * u_tiles.xy + hs_tile * side;
#endif
  HS_HIGHP float middle = level < 0.5 ? 5.0 : 5.5;
  return (origin + clamp(texel * perSample + middle, vec2(0.5), side - 0.5)) * u_occlusionLayout.yz;
}
#else
// Where to read a level and the next one: xy and zw.
HS_HIGHP vec4 hs_levelPlaces(HS_HIGHP vec2 texel, float lower) {
  vec2 level = vec2(lower, lower + 1.0);
  vec2 coarse = max(level - 3.0, 0.0);
  HS_HIGHP vec2 perSample = exp2(-coarse);
  vec2 row = step(1.5, level), column = step(3.5, level);
#ifdef HS_SUB_LIGHTS_U
  HS_HIGHP vec2 full = u_tiles.zw + 11.0;
  HS_HIGHP vec2 sideX = ceil(u_tiles.z * perSample) + 11.0, sideY = ceil(u_tiles.w * perSample) + 11.0;
  HS_HIGHP vec2 farY = u_tiles.w - ceil(u_tiles.w * 2.0 * perSample) + 13.0 * (coarse - 1.0);
#else
  HS_HIGHP vec2 full = vec2(u_occlusionLayout.x + 11.0);
  HS_HIGHP vec2 sideX = u_occlusionLayout.x * perSample + 11.0, sideY = sideX;
  HS_HIGHP vec2 farY = u_occlusionLayout.x * (1.0 - 2.0 * perSample) + 11.0 * (coarse - 1.0);
#endif
  HS_HIGHP vec2 originX = mix((level - 2.0 * row) * full.x, vec2(2.0 * full.x), column);
  HS_HIGHP vec2 originY = mix(row * full.y, farY, column);
#ifdef HS_SUB_LIGHTS_U
  originX = originX * u_tiles.x + hs_tile.x * sideX;
  originY = originY * u_tiles.y + hs_tile.y * sideY;
#endif
  HS_HIGHP float finest = lower < 0.5 ? 5.0 : 5.5;
  HS_HIGHP vec2 middle = vec2(finest, 5.5);
  HS_HIGHP vec2 x = originX + clamp(texel.x * perSample + middle, vec2(0.5), sideX - 0.5);
  HS_HIGHP vec2 y = originY + clamp(texel.y * perSample + middle, vec2(0.5), sideY - 0.5);
  return vec4(x.x, y.x, x.y, y.y) * u_occlusionLayout.yzyz;
}
#endif
// x: the largest kernel not wider than `width`, y: the share of the next one, twice as wide, for which the mix
// has the second moment of the kernel wanted.
HS_HIGHP vec2 hs_levels(HS_HIGHP float width) {
  HS_HIGHP float wanted = clamp(width, 1.0, exp2(u_occlusionLayout.w));
  float lower = min(floor(log2(wanted)), u_occlusionLayout.w - 1.0);
  HS_HIGHP float ratio = wanted * exp2(-lower);
  return vec2(lower, (ratio * ratio - 1.0) * (1.0 / 3.0));
}
#elif defined(HS_FILTER_MIPMAP)
HS_HIGHP vec2 hs_levelPlace(HS_HIGHP vec2 texel, float level) {
  HS_HIGHP float perSample = exp2(-level);
#ifdef HS_SUB_LIGHTS_U
  HS_HIGHP vec2 side = u_tiles.zw * perSample;
  HS_HIGHP vec2 origin = level < 0.5 ? vec2(0.0) : vec2(u_tiles.z + 2.0, u_tiles.w - 2.0 * side.y + 2.0 * (level - 1.0));
  origin = origin * u_tiles.xy + hs_tile * (side + 2.0) + 1.0;
#else
  HS_HIGHP vec2 side = vec2(u_occlusionLayout.x * perSample);
  HS_HIGHP vec2 origin = level < 0.5 ? vec2(1.0)
                                     : vec2(u_occlusionLayout.x + 3.0, 1.0 + u_occlusionLayout.x - 2.0 * side.y + 2.0 * (level - 1.0));
#endif
  return (origin + clamp(texel * perSample, vec2(-0.5), side + 0.5)) * u_occlusionLayout.yz;
}
// A linear fetch of level l weighs a tent of 2^(l+1) texels, as wide as a box of sqrt(3) 2^l.
HS_HIGHP vec2 hs_levels(HS_HIGHP float width) {
  float level = clamp(log2(max(width * (1.0 / 1.7320508), 1.0)), 0.0, u_occlusionLayout.w);
  float lower = min(floor(level), u_occlusionLayout.w - 1.0);
  return vec2(lower, level - lower);
}
#endif

#ifdef HS_FILTER_SAT
// Sum over all texels before a corner of the texel grid, as bytes.
HS_HIGHP vec3 hs_sumBefore(HS_HIGHP sampler2D sums, HS_HIGHP vec2 corner, vec2 tile) {
  HS_COUNT(1);
  HS_HIGHP vec2 last = clamp(corner, vec2(0.0), hs_mapTexels) - 0.5;
  float inside = step(0.0, min(last.x, last.y));
#ifdef HS_SUB_LIGHTS_U
  HS_HIGHP vec2 place = max(last, 0.5) + tile * u_occlusionLayout.x + hs_tile * u_tiles.zw;
#else
  HS_HIGHP vec2 place = max(last, 0.5) + tile * u_occlusionLayout.x;
#endif
  return floor(texture2D(sums, place * u_occlusionLayout.y).rgb * 255.0 + 0.5) * inside;
}
#ifdef HS_SAT_SMOOTH
// The integral of the texels over everything before any point: exact between texels too, for four fetches.
HS_HIGHP vec3 hs_corner(HS_HIGHP sampler2D sums, HS_HIGHP vec2 at, vec2 tile) {
  HS_HIGHP vec2 inside = clamp(at, vec2(0.0), hs_mapTexels);
  HS_HIGHP vec2 low = floor(inside);
  HS_HIGHP vec2 part = inside - low;
  return mix(mix(hs_sumBefore(sums, low, tile), hs_sumBefore(sums, low + vec2(1.0, 0.0), tile), part.x),
             mix(hs_sumBefore(sums, low + vec2(0.0, 1.0), tile), hs_sumBefore(sums, low + 1.0, tile), part.x), part.y);
}
#else
#define hs_corner hs_sumBefore
#endif
float hs_boxMean(HS_HIGHP sampler2D sums, HS_HIGHP vec2 texel, HS_HIGHP float width, vec2 tile) {
  HS_HIGHP vec2 reach = 0.5 * max(width * u_kernelShape.xy, 1.0);
#ifdef HS_SAT_SMOOTH
  HS_HIGHP vec2 low = texel - reach;
  HS_HIGHP vec2 high = texel + reach;
#else
  // Borders on the texel grid: four fetches.
  HS_HIGHP vec2 low = floor(texel - reach + 0.5);
  HS_HIGHP vec2 high = max(floor(texel + reach + 0.5), low + 1.0);
#endif
  HS_HIGHP vec3 bytes = hs_corner(sums, high, tile) - hs_corner(sums, vec2(low.x, high.y), tile) -
                        hs_corner(sums, vec2(high.x, low.y), tile) + hs_corner(sums, low, tile);
  // High bytes first: their differences are small, so that even mediump loses nothing to cancellation. The
  // count is taken in units of 256, since mediump ends at 65504.
  HS_HIGHP float count = (bytes.x * 256.0 + bytes.y) + bytes.z * (1.0 / 256.0);
  HS_HIGHP vec2 side = high - low;
  return clamp(count * u_occlusionLayout.z / side.x / side.y, 0.0, 1.0);
}
float hs_channelMean(HS_HIGHP sampler2D sums, vec2 channel, HS_HIGHP vec2 texel, HS_HIGHP float width) {
  return hs_boxMean(sums, texel, width, channel);
}
vec2 hs_pairMean(HS_HIGHP sampler2D sums, float pair, HS_HIGHP vec2 texel, HS_HIGHP float width) {
  return vec2(hs_boxMean(sums, texel, width, vec2(0.0, pair)), hs_boxMean(sums, texel, width, vec2(1.0, pair)));
}
vec4 hs_pairsMean(HS_HIGHP sampler2D sums, HS_HIGHP vec2 texel, HS_HIGHP float width) {
  return vec4(hs_pairMean(sums, 0.0, texel, width), hs_pairMean(sums, 1.0, texel, width));
}
#else
vec4 hs_squareMean(HS_HIGHP sampler2D levels, HS_HIGHP vec2 texel, HS_HIGHP float width) {
  HS_HIGHP vec2 level = hs_levels(width);
  HS_COUNT(2);
#if defined(HS_FILTER_NBUFFER) && !defined(HS_NO_HIGHP)
  HS_HIGHP vec4 places = hs_levelPlaces(texel, level.x);
  return mix(texture2D(levels, places.xy), texture2D(levels, places.zw), level.y);
#else
  return mix(texture2D(levels, hs_levelPlace(texel, level.x)), texture2D(levels, hs_levelPlace(texel, level.x + 1.0)), level.y);
#endif
}
#if HS_BOXES > 1
// An elongated light: squares side by side.
vec4 hs_levelFetch(HS_HIGHP sampler2D levels, HS_HIGHP vec2 texel, HS_HIGHP float width) {
  HS_HIGHP vec2 stride = step(u_kernelShape.yx, u_kernelShape.xy) * (width / float(HS_BOXES));
  HS_HIGHP vec2 place = texel - stride * (0.5 * float(HS_BOXES - 1));
  vec4 sum = vec4(0.0);
  for (int i = 0; i < HS_BOXES; ++i) {
    sum += hs_squareMean(levels, place, width * u_kernelShape.z);
    place += stride;
  }
  return sum * (1.0 / float(HS_BOXES));
}
#else
#define hs_levelFetch hs_squareMean
#endif
float hs_channelMean(HS_HIGHP sampler2D levels, vec2 channel, HS_HIGHP vec2 texel, HS_HIGHP float width) {
  vec4 mean = hs_levelFetch(levels, texel, width);
  vec2 columns = mix(mean.rb, mean.ga, channel.x);
  return mix(columns.x, columns.y, channel.y);
}
vec2 hs_pairMean(HS_HIGHP sampler2D levels, float pair, HS_HIGHP vec2 texel, HS_HIGHP float width) {
#if defined(HS_NO_HIGHP) && HS_BOXES == 1
  // Half of the first fetch is left before the second: a value of its own takes half as many registers.
  HS_HIGHP vec2 level = hs_levels(width);
  HS_COUNT(2);
  vec4 finer = texture2D(levels, hs_levelPlace(texel, level.x));
  vec2 nearer = min(mix(finer.rg, finer.ba, pair), vec2(1.0));
  vec4 coarser = texture2D(levels, hs_levelPlace(texel, level.x + 1.0));
  return mix(nearer, mix(coarser.rg, coarser.ba, pair), level.y);
#else
  vec4 mean = hs_levelFetch(levels, texel, width);
  return mix(mean.rg, mean.ba, pair);
#endif
}
#define hs_pairsMean hs_levelFetch
#endif
