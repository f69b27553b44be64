// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Bounds over blocks of HS_CELL x HS_CELL source texels and their neighbours up to HS_REACH blocks away: afterwards
// one block covers every tap of a kernel whose radius is at most HS_REACH blocks, wherever in the block the receiver
// falls.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceSize;  // x: texels per side, y: 1 / x
#define HS_SIDE ((2 * HS_REACH + 1) * HS_CELL)

float hs_lexicographicLess(vec2 a, vec2 b) {
  vec2 order = sign(b - a);
  return step(0.5, 2.0 * order.x + order.y);
}

void main() {
  HS_HIGHP vec2 block = floor(v_uv * (u_sourceSize.x / float(HS_CELL)));
  HS_HIGHP vec2 first = ((block - float(HS_REACH)) * float(HS_CELL) + 0.5) * u_sourceSize.y;
  vec4 result = floor(texture2D(u_source, first) * 255.0 + 0.5);
  HS_HIGHP vec2 offset = vec2(0.0);
  for (int i = 1; i < HS_SIDE * HS_SIDE; ++i) {
    offset.x += 1.0;
    float wrapped = step(float(HS_SIDE) - 0.5, offset.x);
    offset += wrapped * vec2(-float(HS_SIDE), 1.0);
    vec4 other = floor(texture2D(u_source, first + offset * u_sourceSize.y) * 255.0 + 0.5);
    result.xy = mix(result.xy, other.xy, hs_lexicographicLess(other.xy, result.xy));
    result.zw = mix(result.zw, other.zw, hs_lexicographicLess(result.zw, other.zw));
  }
  gl_FragColor = (result + 0.25) / 255.0;
}
