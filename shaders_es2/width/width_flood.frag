// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One step of jump flooding: the best of nine known offsets, a stride apart.
// Based on: Rong, Tan, "Jump Flooding in GPU with Applications to Voronoi Diagram and Distance Transform", 2006.
// HS_TILES: offsets of other maps of the image do not count.
#include "width/width_offset.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_offsets;
uniform HS_HIGHP vec4 u_widthLayout;  // xy: texels per side, zw: 1 / xy
uniform HS_HIGHP vec4 u_flood;        // x: stride in texels
#ifdef HS_TILES
uniform HS_HIGHP vec4 u_widthTile;    // xy: texels per side of a map, zw: 1 / xy
#endif

#ifdef HS_NO_HIGHP
// See width_coverage.frag.
#define HS_TURNS (9 + 32)
#else
#define HS_TURNS 9
#endif

void main() {
  HS_HIGHP vec2 cell = floor(v_uv * u_widthLayout.xy) + 0.5;
#ifdef HS_TILES
  HS_HIGHP vec2 low = floor(cell * u_widthTile.zw) * u_widthTile.xy;
  HS_HIGHP vec2 high = low + u_widthTile.xy;
#else
  HS_HIGHP vec2 low = vec2(0.0);
  HS_HIGHP vec2 high = u_widthLayout.xy;
#endif
  HS_HIGHP vec2 best = vec2(0.0);
  HS_HIGHP float bestLength = 60000.0;
  HS_HIGHP vec2 neighbour = vec2(-1.0);
#ifdef HS_NO_HIGHP
  HS_HIGHP float end = 9.0 + min(u_flood.x, 0.0);
#endif
  for (int i = 0; i < HS_TURNS; ++i) {
#ifdef HS_NO_HIGHP
    if (float(i) >= end) break;
#endif
    HS_HIGHP vec2 jump = neighbour * u_flood.x;
    HS_HIGHP vec2 at = cell + jump;
    HS_HIGHP vec4 bytes = hs_offsetBytes(texture2D(u_offsets, at * u_widthLayout.zw));
    HS_HIGHP vec2 offset = jump + hs_offsetTexels(bytes);
    // A sixteenth keeps the square of 127 texels inside fp16.
    HS_HIGHP vec2 scaled = offset * (1.0 / 16.0);
    HS_HIGHP float squared = dot(scaled, scaled);
    HS_HIGHP vec2 inside = step(low, at) * step(at, high);
    bool usable = hs_offsetKnown(bytes) && inside.x * inside.y > 0.5 && max(abs(offset.x), abs(offset.y)) < 126.0;
    if (usable && squared < bestLength) {
      bestLength = squared;
      best = offset;
    }
    neighbour.x += 1.0;
    float wrapped = step(1.5, neighbour.x);
    neighbour += wrapped * vec2(-3.0, 1.0);
  }
  gl_FragColor = bestLength < 59999.0 ? hs_packOffset(best) : vec4(0.0);
}
