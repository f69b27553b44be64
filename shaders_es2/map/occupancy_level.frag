// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Occupied share and mean depth of HS_CELL x HS_CELL texels of a finer level, each weighted by its own share.
#include "map/occupancy_storage.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceRect;   // xy: first texel that is read, z: texels per side, w: cells per side
uniform HS_HIGHP vec4 u_sourceScale;  // xy: 1 / size of the source in texels

void main() {
  HS_HIGHP vec2 first = u_sourceRect.xy + floor(v_uv * u_sourceRect.w) * float(HS_CELL) + 0.5;
  HS_HIGHP vec2 offset = vec2(0.0);
  HS_HIGHP vec2 sum = vec2(0.0);
  for (int i = 0; i < HS_CELL * HS_CELL; ++i) {
    HS_HIGHP vec2 occupancy =
        hs_unpackOccupancy(texture2D(u_source, (first + offset) * u_sourceScale.xy)) * (1.0 / 255.0);
    sum += occupancy.x * vec2(1.0, occupancy.y);
    offset.x += 1.0;
    float wrapped = step(float(HS_CELL) - 0.5, offset.x);
    offset += wrapped * vec2(-float(HS_CELL), 1.0);
  }
  gl_FragColor = hs_packOccupancy(
      vec2(sum.x * (1.0 / float(HS_CELL * HS_CELL)), sum.x > 0.0 ? sum.y / sum.x : 0.0));
}
