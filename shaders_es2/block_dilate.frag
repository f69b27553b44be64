// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Bounds over the neighbouring blocks up to HS_REACH away: afterwards one block covers every tap of a kernel whose
// radius is at most HS_REACH blocks, wherever in the block the receiver falls.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceSize;

float hs_lexicographicLess(vec2 a, vec2 b) {
  vec2 order = sign(b - a);
  return step(0.5, 2.0 * order.x + order.y);
}

void main() {
  vec4 result = floor(texture2D(u_source, v_uv) * 255.0 + 0.5);
  HS_HIGHP vec2 offset = vec2(-float(HS_REACH));
  for (int i = 0; i < (2 * HS_REACH + 1) * (2 * HS_REACH + 1); ++i) {
    vec4 other = floor(texture2D(u_source, v_uv + offset * u_sourceSize.y) * 255.0 + 0.5);
    result.xy = mix(result.xy, other.xy, hs_lexicographicLess(other.xy, result.xy));
    result.zw = mix(result.zw, other.zw, hs_lexicographicLess(result.zw, other.zw));
    offset.x += 1.0;
    float wrapped = step(float(HS_REACH) + 0.5, offset.x);
    offset += wrapped * vec2(-float(2 * HS_REACH + 1), 1.0);
  }
  gl_FragColor = (result + 0.25) / 255.0;
}
