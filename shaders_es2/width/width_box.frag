// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Means over boxes of twice the side: four boxes of half the side beside each other. HS_TILES: nothing lies beyond the
// borders of the image's maps.
// Based on: Decoret, "N-Buffers for Efficient Depth Map Query", 2005, section 3 (the doubling).
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_coverage;
uniform HS_HIGHP vec4 u_widthLayout;  // xy: texels per side, zw: 1 / xy
uniform HS_HIGHP vec4 u_box;          // x: texels to the neighbour boxes, signed
#ifdef HS_TILES
uniform HS_HIGHP vec4 u_widthTile;    // xy: texels per side of a map, zw: 1 / xy
#endif

void main() {
  HS_HIGHP vec2 cell = (floor(v_uv * u_widthLayout.xy) + 0.5) * u_widthLayout.zw;
  HS_HIGHP vec2 s = vec2(u_box.x * u_widthLayout.z, 0.0);
  HS_HIGHP vec2 t = vec2(0.0, u_box.x * u_widthLayout.w);
#ifdef HS_TILES
  HS_HIGHP vec2 texel = cell * u_widthLayout.xy;
  HS_HIGHP vec2 beyond = abs(floor((texel + u_box.x) * u_widthTile.zw) - floor(texel * u_widthTile.zw));
  HS_HIGHP vec2 inside = 1.0 - min(beyond, 1.0);
  HS_HIGHP vec2 sum = texture2D(u_coverage, cell).rg + inside.x * texture2D(u_coverage, cell + s).rg +
                      inside.y * texture2D(u_coverage, cell + t).rg +
                      inside.x * inside.y * texture2D(u_coverage, cell + s + t).rg;
#else
  HS_HIGHP vec2 sum = texture2D(u_coverage, cell).rg + texture2D(u_coverage, cell + s).rg +
                      texture2D(u_coverage, cell + t).rg + texture2D(u_coverage, cell + s + t).rg;
#endif
  gl_FragColor = vec4((floor(sum * (255.0 / 4.0) + 0.5) + 0.25) / 255.0, 0.0, 1.0);
}
