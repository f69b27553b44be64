// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A mip level of several maps that stand in rows, each with an empty margin of one texel. Drawn into a
// viewport in which each takes an even number of pixels, so that the implicit level of detail selects the level.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_tiles;  // xy: columns and rows, zw: texels of a map on this level

void main() {
  HS_HIGHP vec2 place = floor(v_uv * (u_tiles.xy * (u_tiles.zw + 2.0)));
  HS_HIGHP vec2 tile = floor((place + 0.5) / (u_tiles.zw + 2.0));
  HS_HIGHP vec2 local = place - tile * (u_tiles.zw + 2.0) - 1.0;
  HS_HIGHP vec2 inside = step(vec2(-0.25), local) * step(local, u_tiles.zw - 0.75);
  gl_FragColor = texture2D(u_source, (tile * u_tiles.zw + local + 0.5) / (u_tiles.xy * u_tiles.zw)) * (inside.x * inside.y);
}
