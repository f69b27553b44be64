// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Walks the silhouette vertices that matter for the fragment's tile: four sub-lights, each with silhouettes of
// its own; per caster the covered share of each light cell, over casters their product.
#include "receiver/tap_count.glsl"
#include "list/cell_coverage.glsl"
#include "list/list_vertices.glsl"
#define HS_SUB_LIGHTS 4.0
#include "map/half_plane.glsl"
#include "list/caster_lists.glsl"
#include "list/cell_walk.glsl"
#include "list/light_grid.glsl"
#include "list/facet_tree.glsl"
#include "list/gathered_cells.glsl"

float halfshadow_class() {
  hs_findList();
  return hs_listed ? -1.0 : 0.25 * hs_limitedLight(hs_lit);
}

float halfshadow_visibility() { return 0.25 * hs_gatheredLight(); }
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
