// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What receivers read: signed distance to the nearest silhouette (inside positive), the direction to it, the
// normalised distance of the caster there from the light, and the largest around.
#include "receiver/tap_count.glsl"
#include "width/width_offset.glsl"
#include "width/width_boxes.glsl"
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
  if (known && side < 0.0) {
    // Outside, the casters in a box that reaches half as far again: where two silhouettes are equally near, one
    // takes over from the other without a seam.
    HS_HIGHP float level = clamp(log2(max(3.0 * texels, 2.0)), 1.0, u_boxLayout.z + 1.0);
    HS_HIGHP float lower = min(floor(level), u_boxLayout.z);
    HS_HIGHP vec4 boxes = hs_boxes(cell, lower);
    HS_HIGHP vec2 mean = mix(boxes.rg, boxes.ba, clamp(level - lower, 0.0, 1.0));
    depth = mix(depth, mean.y / max(mean.x, 1e-3), min(16.0 * mean.x, 1.0));
  }
  HS_HIGHP float signedTexels = known ? side * texels : side * u_widthRange.x;
  HS_HIGHP float alongY = known && texels > 0.01 ? abs(offset.y) / texels : 0.0;
  gl_FragColor = vec4(hs_packDistance(signedTexels, u_widthRange.xy), clamp(alongY, 0.0, 1.0), depth, largest);
}
