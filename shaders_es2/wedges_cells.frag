// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Walks the silhouette vertices that matter for the fragment's tile: four sub-lights, each with silhouettes of
// its own; per caster the covered share of each light cell, over casters their product.
#include "tap_count.glsl"
#include "cell_coverage.glsl"
#include "list_vertices.glsl"
#define HS_SUB_LIGHTS 4.0
#include "caster_lists.glsl"
#include "cell_walk.glsl"

float halfshadow_class() {
  hs_findList();
  return hs_listed ? -1.0 : 0.25 * hs_lit;
}

float halfshadow_visibility() {
  hs_findList();
  HS_HIGHP vec2 at = hs_firstVertex();
  HS_HIGHP vec3 origin = hs_listOrigin();
  HS_Walk walk;
  hs_startWalk(walk);
  HS_Cells visible = HS_CELLS_ALL(1.0);
  HS_Cells covered = HS_CELLS_ALL(0.0);
  for (int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!hs_listed) break;
    HS_Tags tags;
    HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
    hs_walk(walk, covered, projected, tags);
    hs_foldCaster(visible, covered, step(0.5, tags.ends));
    hs_lit += hs_takeSquare(visible, step(1.5, tags.ends));
    if (tags.ends > 2.5) break;
  }
  return 0.25 * hs_lit;
}
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
