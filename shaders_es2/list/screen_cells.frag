// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Visibility from light cells that casters left on the screen: their mean.
#include "receiver/tap_count.glsl"
#ifdef HS_CASTING_RECEIVER
// Among a caster's own surfaces its silhouettes do not tell what it covers: these receivers walk lists of faces.
#define HS_SUB_LIGHTS 4.0
#include "list/cell_coverage.glsl"
#include "list/list_vertices.glsl"
#include "map/half_plane.glsl"
#include "list/caster_lists.glsl"
#include "list/cell_walk.glsl"
#include "list/light_grid.glsl"
#include "list/facet_tree.glsl"
#include "list/gathered_cells.glsl"
float halfshadow_visibility() { return 0.25 * hs_gatheredLight(); }
#else
uniform HS_HIGHP sampler2D u_cells0;
#if HS_CELL_TARGETS >= 4
uniform HS_HIGHP sampler2D u_cells1;
uniform HS_HIGHP sampler2D u_cells2;
uniform HS_HIGHP sampler2D u_cells3;
#endif
uniform HS_HIGHP vec4 u_viewport;  // xy: 1 / size, zw: -origin / size
varying HS_HIGHP vec4 v_map;       // w: height over the light's plane
float halfshadow_visibility() {
  HS_COUNT(HS_CELL_TARGETS);
  HS_HIGHP vec2 at = gl_FragCoord.xy * u_viewport.xy + u_viewport.zw;
  HS_HIGHP vec4 sum = texture2D(u_cells0, at);
#if HS_CELL_TARGETS >= 4
  sum += texture2D(u_cells1, at) + texture2D(u_cells2, at) + texture2D(u_cells3, at);
#endif
  // Behind the light's plane it shines on nothing.
  return v_map.w <= 0.0 ? 1.0 : dot(sum, vec4(0.25 / float(HS_CELL_TARGETS)));
}
#endif
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
