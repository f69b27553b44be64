// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What receivers read: signed distance to the nearest silhouette (inside positive), the direction to it, the
// normalised distance of the caster there from the light, and the largest around. HS_BOXES: outside, that of casters
// around. HS_CORNER_SHARE: in place of the direction what edge_profile.glsl misses.
#include "receiver/tap_count.glsl"
#include "width/width_offset.glsl"
#ifdef HS_BOXES
#include "width/width_boxes.glsl"
#else
uniform HS_HIGHP vec4 u_widthLayout;  // xy: texels per side, zw: 1 / xy
#endif
#ifdef HS_TILES
uniform HS_HIGHP vec4 u_widthTile;  // xy: texels per side of a map, zw: 1 / xy
#endif
#ifdef HS_CORNER_SHARE
#include "width/edge_profile.glsl"

HS_HIGHP float hs_edgeShare(HS_HIGHP float signedTexels, float level) {
  HS_HIGHP float part = hs_smallerPart(abs(signedTexels) * inversesqrt(hs_boxSideSquared(level)));
  return signedTexels < 0.0 ? part : 1.0 - part;
}

// What the straight edge's profile misses of the occupied share of the kernel that the farthest receiver has.
HS_HIGHP float hs_cornerShare(HS_HIGHP float signedTexels, HS_HIGHP float depth, HS_HIGHP vec2 texel, HS_HIGHP vec2 corner) {
  HS_HIGHP float width = u_kernel.z - u_kernel.y * depth;
  HS_HIGHP float level = 0.5 * log2(max(width * width - 2.0, 4.0));
  HS_HIGHP float lower = clamp(floor(level), 1.0, u_boxLayout.z);
  HS_HIGHP vec4 boxes = hs_boxes(texel, lower, corner, u_widthTile.xy);
  return mix(boxes.r - hs_edgeShare(signedTexels, lower), boxes.b - hs_edgeShare(signedTexels, lower + 1.0),
             clamp(level - lower, 0.0, 1.0));
}
#endif
#include "width/width_distance.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_offsets;
uniform HS_HIGHP sampler2D u_coverage;
uniform HS_HIGHP vec4 u_widthRange;   // x: largest distance, y: knee of the storage

void main() {
  HS_HIGHP vec2 cell = floor(v_uv * u_widthLayout.xy) + 0.5;
  HS_HIGHP vec4 bytes = hs_offsetBytes(texture2D(u_offsets, cell * u_widthLayout.zw));
  HS_HIGHP vec4 here = texture2D(u_coverage, cell * u_widthLayout.zw);
  float side = here.r >= 0.5 ? 1.0 : -1.0;
  HS_HIGHP vec2 offset = hs_offsetTexels(bytes);
  // A sixteenth keeps squares inside fp16.
  HS_HIGHP float texels = 16.0 * length(offset * (1.0 / 16.0));
  bool known = hs_offsetKnown(bytes);

  HS_HIGHP vec2 edge = known ? floor(cell + offset) + 0.5 : cell;
  HS_HIGHP vec2 edgeSum = vec2(0.0);
  HS_HIGHP float largest = 0.0;
  HS_HIGHP vec2 neighbour = vec2(-1.0);
  for (int i = 0; i < 9; ++i) {
    edgeSum += texture2D(u_coverage, (edge + neighbour) * u_widthLayout.zw).rg;
    largest = max(largest, texture2D(u_coverage, (cell + neighbour) * u_widthLayout.zw).b);
    neighbour.x += 1.0;
    float wrapped = step(1.5, neighbour.x);
    neighbour += wrapped * vec2(-3.0, 1.0);
  }
  HS_HIGHP float depth = edgeSum.y / max(edgeSum.x, 1e-3);
#ifdef HS_BOXES
#ifdef HS_TILES
  HS_HIGHP vec2 corner = floor(cell * u_widthTile.zw) * u_widthTile.xy;
  HS_HIGHP vec2 size = u_widthTile.xy;
#else
  HS_HIGHP vec2 corner = vec2(0.0);
  HS_HIGHP vec2 size = u_widthLayout.xy;
#endif
  if (known && side < 0.0) {
    // Outside, the casters in a box that reaches half as far again: where two silhouettes are equally near, one
    // takes over from the other without a seam.
    HS_HIGHP float level = clamp(log2(max(3.0 * texels, 2.0)), 1.0, u_boxLayout.z + 1.0);
    HS_HIGHP float lower = min(floor(level), u_boxLayout.z);
    HS_HIGHP vec4 boxes = hs_boxes(cell - corner, lower, corner, size);
    HS_HIGHP vec2 mean = mix(boxes.rg, boxes.ba, clamp(level - lower, 0.0, 1.0));
    depth = mix(depth, mean.y / max(mean.x, 1e-3), min(16.0 * mean.x, 1.0));
  }
#endif
  HS_HIGHP float signedTexels = known ? side * texels : side * u_widthRange.x;
  HS_HIGHP float alongY = known && texels > 0.01 ? abs(offset.y) / texels : 0.0;
#ifdef HS_CORNER_SHARE
  alongY = (floor(127.5 + 127.0 * clamp(hs_cornerShare(signedTexels, depth, cell - corner, corner), -1.0, 1.0)) + 0.25) / 255.0;
#endif
  gl_FragColor = vec4(hs_packDistance(signedTexels, u_widthRange.xy), clamp(alongY, 0.0, 1.0), depth, largest);
}
