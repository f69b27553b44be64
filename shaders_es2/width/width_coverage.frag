// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Share of a rectangle of depth texels that holds a caster, that share times the casters' mean normalised
// distance, and their largest, rounded up: HS_SAMPLES_S x HS_SAMPLES_T fetches. The image is wider than the depth map by
// a margin, in which penumbrae of casters at the border lie. HS_TILES: so is each of the maps that stand in the image.
#include "map/depth_storage.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_depthMap;
#ifdef HS_LAST_RECEIVERS
uniform HS_HIGHP sampler2D u_lastReceivers;  // depths beyond which nothing is shadowed
uniform HS_HIGHP vec4 u_lastMargin;          // x: least depth from a caster to what it shadows
#endif
uniform HS_HIGHP vec4 u_sourceSize;   // x: depth texels per side of a map, y: 1 / of the image
uniform HS_HIGHP vec4 u_widthLayout;  // xy: texels per side, zw: 1 / xy
#ifdef HS_TILES
uniform HS_HIGHP vec4 u_widthTile;    // xy: texels per side of a map, zw: 1 / xy
#endif
uniform HS_HIGHP vec4 u_widthPlace;   // xy: texels per depth texel, z: margin in texels
uniform HS_HIGHP vec4 u_casterRange;  // x: nearest caster's distance beyond the near distance, y: 1 / range of distances, z: depth of empty texels less a margin, w: 1 / depth units

#ifdef HS_NO_HIGHP
// More than compilers unroll, which takes more registers than devices of this rung have; the end is found on the way.
#define HS_TURNS (HS_SAMPLES_S * HS_SAMPLES_T + 32)
#else
#define HS_TURNS (HS_SAMPLES_S * HS_SAMPLES_T)
#endif

void main() {
  const HS_HIGHP vec2 counts = vec2(float(HS_SAMPLES_S), float(HS_SAMPLES_T));
  HS_HIGHP vec2 cell = floor(v_uv * u_widthLayout.xy) - u_widthPlace.z;
#ifdef HS_TILES
  HS_HIGHP vec2 tile = floor((cell + u_widthPlace.z + 0.5) * u_widthTile.zw);
  cell -= tile * u_widthTile.xy;
  HS_HIGHP vec2 corner = tile * u_sourceSize.x;
#endif
  HS_HIGHP vec2 offset = vec2(0.5);
  HS_HIGHP vec2 sum = vec2(0.0);
  HS_HIGHP float largest = 0.0;
#ifdef HS_NO_HIGHP
  HS_HIGHP float end = counts.x * counts.y + min(u_sourceSize.x, 0.0);
#endif
  for (int i = 0; i < HS_TURNS; ++i) {
#ifdef HS_NO_HIGHP
    if (float(i) >= end) break;
#endif
    HS_HIGHP vec2 texel = (cell + offset / counts) / u_widthPlace.xy;
#ifdef HS_TILES
    HS_HIGHP vec2 uv = (corner + clamp(texel, vec2(0.5), vec2(u_sourceSize.x - 0.5))) * u_sourceSize.y;
#else
    HS_HIGHP vec2 uv = texel * u_sourceSize.y;
#endif
    // Outside the map nothing is stored; the border texel that a clamped fetch returns is empty too, but a map
    // that its casters fill has no border.
    HS_HIGHP vec2 inside = step(vec2(0.0), texel) * step(texel, vec2(u_sourceSize.x));
    HS_HIGHP float depth = hs_depthValue(texture2D(u_depthMap, uv));
    HS_HIGHP float occupied = step(depth, u_casterRange.z) * inside.x * inside.y;
#ifdef HS_LAST_RECEIVERS
    occupied *= step(u_lastMargin.x, hs_depthValue(texture2D(u_lastReceivers, uv)) - depth);
#endif
#ifdef HS_TILES
    HS_HIGHP float normalised = clamp((depth - u_casterRange.x) * u_casterRange.y, 0.0, 1.0);
#else
    // Distances beyond the near distance, in units of it: of 255 steps of depth a caster beside the light would leave the others one or two.
    HS_HIGHP float share = depth * u_casterRange.w;
    HS_HIGHP float distance = share / max(1.0 - share, 1e-4);
    HS_HIGHP float normalised = clamp((distance - u_casterRange.x) * u_casterRange.y, 0.0, 1.0);
#endif
    sum += occupied * vec2(1.0, normalised);
    largest = max(largest, occupied * normalised);
    offset.x += 1.0;
    float wrapped = step(counts.x, offset.x);
    offset += wrapped * vec2(-counts.x, 1.0);
  }
  sum *= 1.0 / (counts.x * counts.y);
  gl_FragColor = vec4(sum, (ceil(largest * 255.0) + 0.25) / 255.0, 1.0);
}
