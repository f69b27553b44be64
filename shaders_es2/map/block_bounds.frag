// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Smallest and largest depth of HS_FACTOR x HS_FACTOR source texels: 16 bits each, rounded outward.
// First level (HS_FROM_DEPTH): reads the depth map; further levels read this shader's own output. HS_MAPS: over as many
// maps, which stand in rows of HS_TILES.
#include "map/depth_storage.glsl"
#include "map/wider_bounds.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceSize;  // x: texels per side, y: 1 / x, z: blocks per side

#ifdef HS_DEPTH_PACKED16
vec4 hs_bounds(HS_HIGHP vec4 stored) {
  vec4 bytes = floor(stored * 255.0 + 0.5);
#ifdef HS_FROM_DEPTH
  return bytes.rgrg;
#else
  return bytes;
#endif
}
#define HS_Bounds vec4
HS_Bounds hs_merge(HS_Bounds a, HS_Bounds b) { return hs_wider(a, b); }
vec4 hs_packBounds(HS_Bounds b) { return b; }
#else
#define HS_Bounds HS_HIGHP vec2
HS_Bounds hs_bounds(HS_HIGHP vec4 stored) {
#ifdef HS_FROM_DEPTH
  return vec2(hs_depthValue(stored) * 65536.0);
#else
  HS_HIGHP vec4 bytes = floor(stored * 255.0 + 0.5);
  return vec2(bytes.r * 256.0 + bytes.g, bytes.b * 256.0 + bytes.a + 0.5);
#endif
}
HS_Bounds hs_merge(HS_Bounds a, HS_Bounds b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }
vec4 hs_packBounds(HS_Bounds b) {
  // The reader adds one step to the upper bound, so flooring both is outward.
  HS_HIGHP vec2 whole = clamp(floor(b), 0.0, 65535.0);
  HS_HIGHP vec2 high = floor(whole / 256.0);
  HS_HIGHP vec2 low = whole - 256.0 * high;
  return vec4(high.x, low.x, high.y, low.y);
}
#endif

// first: centre of the block's first source texel, as texture coordinates.
HS_Bounds hs_blockBounds(HS_HIGHP vec2 first) {
  HS_Bounds bounds = hs_bounds(texture2D(u_source, first));
  HS_HIGHP vec2 offset = vec2(0.0);
  for (int i = 1; i < HS_FACTOR * HS_FACTOR; ++i) {
    offset.x += 1.0;
    float wrapped = step(float(HS_FACTOR) - 0.5, offset.x);
    offset += wrapped * vec2(-float(HS_FACTOR), 1.0);
    bounds = hs_merge(bounds, hs_bounds(texture2D(u_source, first + offset * u_sourceSize.y)));
  }
  return bounds;
}

void main() {
  HS_HIGHP vec2 first = (floor(v_uv * u_sourceSize.z) * float(HS_FACTOR) + 0.5) * u_sourceSize.y;
  HS_Bounds bounds = hs_blockBounds(first);
#ifdef HS_MAPS
  HS_HIGHP vec2 tile = vec2(0.0);
  for (int i = 1; i < HS_MAPS; ++i) {
    tile.x += 1.0;
    float wrapped = step(float(HS_TILES) - 0.5, tile.x);
    tile += wrapped * vec2(-float(HS_TILES), 1.0);
    bounds = hs_merge(bounds, hs_blockBounds(first + tile * (1.0 / float(HS_TILES))));
  }
#endif
  gl_FragColor = (hs_packBounds(bounds) + 0.25) / 255.0;
}
