// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One step of the shadow-width map: the smallest of a texel and its neighbours plus a difference, in bytes.
// Based on: Kirsch, Doellner, "Real-Time Soft Shadows Using a Single Light Sample", 2003, section 4.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_difference;              // x: difference in bytes
uniform HS_HIGHP vec4 u_neighbours[HS_NEIGHBOURS];  // xy: offset in texture coordinates
void main() {
  float smallest = floor(texture2D(u_source, v_uv).r * 255.0 + 0.5);
  for (int i = 0; i < HS_NEIGHBOURS; ++i) {
    float neighbour = floor(texture2D(u_source, v_uv + u_neighbours[i].xy).r * 255.0 + 0.5);
    smallest = min(smallest, neighbour + u_difference.x);
  }
  gl_FragColor = vec4((smallest + 0.25) / 255.0);
}
