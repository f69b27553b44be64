// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A mip level of several maps that stand in rows of a square, each with an empty margin of one texel. Drawn into a
// viewport in which each takes an even number of pixels, so that the implicit level of detail selects the level.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_tiles;  // x: maps in a row, y: texels per side of one on this level

void main() {
  HS_HIGHP vec2 place = floor(v_uv * (u_tiles.x * (u_tiles.y + 2.0)));
  HS_HIGHP vec2 tile = floor((place + 0.5) / (u_tiles.y + 2.0));
  HS_HIGHP vec2 local = place - tile * (u_tiles.y + 2.0) - 1.0;
  HS_HIGHP vec2 inside = step(vec2(-0.25), local) * step(local, vec2(u_tiles.y - 0.75));
  gl_FragColor = texture2D(u_source, (tile * u_tiles.y + local + 0.5) / (u_tiles.x * u_tiles.y)) * (inside.x * inside.y);
}
