// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Smallest and largest depth around a block over HS_MAPS maps, which stand in rows of HS_TILES tiles.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceRect;   // xy: first texel that is read, w: blocks per side of a tile
uniform HS_HIGHP vec4 u_sourceScale;  // xy: 1 / size of the source in texels

float hs_lexicographicLess(vec2 a, vec2 b) {
  vec2 order = sign(b - a);
  return step(0.5, 2.0 * order.x + order.y);
}

vec4 hs_bytes(HS_HIGHP vec2 texel) {
  return floor(texture2D(u_source, (u_sourceRect.xy + texel) * u_sourceScale.xy) * 255.0 + 0.5);
}

void main() {
  HS_HIGHP vec2 block = floor(v_uv * u_sourceRect.w) + 0.5;
  vec4 result = hs_bytes(block);
  HS_HIGHP vec2 tile = vec2(0.0);
  for (int i = 1; i < HS_MAPS; ++i) {
    tile.x += 1.0;
    float wrapped = step(float(HS_TILES) - 0.5, tile.x);
    tile += wrapped * vec2(-float(HS_TILES), 1.0);
    vec4 other = hs_bytes(block + tile * u_sourceRect.w);
    result.xy = mix(result.xy, other.xy, hs_lexicographicLess(other.xy, result.xy));
    result.zw = mix(result.zw, other.zw, hs_lexicographicLess(result.zw, other.zw));
  }
  gl_FragColor = (result + 0.25) / 255.0;
}
