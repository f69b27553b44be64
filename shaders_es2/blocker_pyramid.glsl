// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Mean occupancy and depth of casters over a region of the map, from an atlas of mip levels: level 0 on the
// left, the others stacked on its right, each inside a gutter of empty texels ("nothing there" outside).
uniform HS_HIGHP sampler2D u_pyramid;
// x: side of level 0, yz: 1 / atlas size, w: last level
uniform HS_HIGHP vec4 u_pyramidLayout;
// x: depth of the nearest caster, y: depth range of casters, z: texels of the depth map per texel of level 0,
// w: depth of the farthest caster
uniform HS_HIGHP vec4 u_pyramidRange;

HS_HIGHP vec2 hs_pyramidLevel(HS_HIGHP vec2 uv, float level) {
  HS_HIGHP float side = u_pyramidLayout.x * exp2(-level);
  HS_HIGHP vec2 origin =
      level < 0.5 ? vec2(1.0) : vec2(u_pyramidLayout.x + 3.0, 1.0 + u_pyramidLayout.x - 2.0 * side + 2.0 * (level - 1.0));
  HS_HIGHP vec2 local = clamp(uv * side, -0.5, side + 0.5);
  HS_COUNT(1);
  return texture2D(u_pyramid, (origin + local) * u_pyramidLayout.yz).rg;
}

// x: occupied share, y: share times normalised depth, over about widthTexels of the depth map.
HS_HIGHP vec2 hs_occupancy(HS_HIGHP vec2 texel, HS_HIGHP float widthTexels) {
  // A bilinear fetch of level l weighs a tent of 2^(l+1) level-0 texels: as wide as the region at
  // 2^l = width / 2.
  HS_HIGHP float level = clamp(log2(max(widthTexels / (2.0 * u_pyramidRange.z), 1.0)), 0.0, u_pyramidLayout.w);
  HS_HIGHP vec2 uv = texel * u_map.y;
#ifdef HS_NEAREST_LEVEL
  return hs_pyramidLevel(uv, floor(level + 0.5));
#else
  HS_HIGHP float lower = floor(level);
  return mix(hs_pyramidLevel(uv, lower), hs_pyramidLevel(uv, min(lower + 1.0, u_pyramidLayout.w)), level - lower);
#endif
}

// Depth of the mean blocker in depth units.
HS_HIGHP float hs_meanBlockerDepth(HS_HIGHP vec2 occupancy) {
  return u_pyramidRange.x + u_pyramidRange.y * (occupancy.y / max(occupancy.x, 1e-3));
}
