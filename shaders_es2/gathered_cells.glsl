// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Walks the list of the fragment's tile: per caster the covered share of each light cell, over casters the
// product of what each leaves visible, or, with HS_SUM_CASTERS, 1 less the sum. Needs cell_walk.glsl and
// caster_lists.glsl.
#ifdef HS_SUM_CASTERS
#define HS_FOLD_AT 1.5
#else
#define HS_FOLD_AT 0.5
#endif

// Visible sub-lights, of HS_SUB_LIGHTS.
HS_HIGHP float hs_gatheredLight() {
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
    hs_foldCaster(visible, covered, step(HS_FOLD_AT, tags.ends));
    hs_lit += hs_takeSquare(visible, step(1.5, tags.ends));
    if (tags.ends > 2.5) break;
  }
  return hs_lit;
}
