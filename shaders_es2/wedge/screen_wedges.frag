// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Visibility from what wedges left on the screen: sums of coverage, shares of
// quadrants that are covered, or the visibility itself.
#include "receiver/tap_count.glsl"
#ifdef HS_CASTING_RECEIVER
// Among a caster's own surfaces its silhouettes do not tell what it covers: these receivers walk lists of faces.
#ifdef HS_WEDGE_SUMS
#define HS_SUM_CASTERS
#endif
#define HS_CELLS 16
#define HS_WHOLE_LIGHT
#define HS_SUB_LIGHTS 1.0
#include "list/cell_coverage.glsl"
#include "list/list_vertices.glsl"
#include "map/half_plane.glsl"
#include "list/caster_lists.glsl"
#include "list/cell_walk.glsl"
#include "list/light_grid.glsl"
#include "list/facet_tree.glsl"
#include "list/gathered_cells.glsl"
float halfshadow_visibility() { return hs_gatheredLight(); }
#else
#include "wedge/wedge_sums.glsl"
uniform HS_HIGHP sampler2D u_wedges;
uniform HS_HIGHP vec4 u_viewport;  // xy: 1 / size, zw: -origin / size
uniform HS_HIGHP vec4 u_wedgeSteps;
varying HS_HIGHP vec4 v_map;  // w: height over the light's plane
float halfshadow_visibility() {
  HS_COUNT(1);
  HS_HIGHP vec4 stored = texture2D(u_wedges, gl_FragCoord.xy * u_viewport.xy + u_viewport.zw);
  // Behind the light's plane it shines on nothing.
  if (v_map.w <= 0.0) return 1.0;
#ifdef HS_WEDGE_SUMS
  return 1.0 - clamp(hs_decodeCoverage(stored, u_wedgeSteps.x), 0.0, 1.0);
#elif defined(HS_WEDGE_SHARES)
  return 1.0 - dot(stored, vec4(0.25));
#else
  return stored.r;
#endif
}
#endif
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
