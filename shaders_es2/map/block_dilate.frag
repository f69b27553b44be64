// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Bounds over blocks of HS_CELL x HS_CELL source texels and their neighbours up to HS_REACH_S and HS_REACH_T blocks
// away: afterwards one block covers every tap of a kernel whose radius is at most that many blocks, wherever in the
// block the receiver falls.
#include "map/wider_bounds.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceRect;   // xy: first texel that is read, z: texels per side, w: blocks per side
uniform HS_HIGHP vec4 u_sourceScale;  // xy: 1 / size of the source in texels
#define HS_WIDTH ((2 * HS_REACH_S + 1) * HS_CELL)
#define HS_HEIGHT ((2 * HS_REACH_T + 1) * HS_CELL)

vec4 hs_bytes(HS_HIGHP vec2 texel) {
  HS_HIGHP vec2 inside = clamp(texel, vec2(0.0), vec2(u_sourceRect.z - 1.0));
  return floor(texture2D(u_source, (u_sourceRect.xy + inside + 0.5) * u_sourceScale.xy) * 255.0 + 0.5);
}

void main() {
  HS_HIGHP vec2 reach = vec2(float(HS_REACH_S), float(HS_REACH_T));
  HS_HIGHP vec2 first = (floor(v_uv * u_sourceRect.w) - reach) * float(HS_CELL);
  vec4 result = hs_bytes(first);
  HS_HIGHP vec2 offset = vec2(0.0);
  for (int i = 1; i < HS_WIDTH * HS_HEIGHT; ++i) {
    offset.x += 1.0;
    float wrapped = step(float(HS_WIDTH) - 0.5, offset.x);
    offset += wrapped * vec2(-float(HS_WIDTH), 1.0);
    result = hs_wider(result, hs_bytes(first + offset));
  }
  gl_FragColor = (result + 0.25) / 255.0;
}
