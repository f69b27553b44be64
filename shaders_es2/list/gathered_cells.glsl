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
  HS_HIGHP vec2 at;
  HS_HIGHP vec3 origin = hs_enterList(at);
  HS_Cells visible = HS_CELLS_ALL(1.0);
  HS_Cells covered = HS_CELLS_ALL(0.0);
#ifdef HS_SIDES
  HS_Cells otherSide = HS_CELLS_ALL(0.0);
#endif
#ifndef HS_CASTING_RECEIVER
  HS_Walk walk;
  hs_startWalk(walk);
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
#ifdef HS_AMONG_RECEIVERS
    if (hs_among) break;
#endif
    if (!hs_listed) break;
    HS_Tags tags;
    HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
    hs_walk(walk, covered, projected, tags);
#ifdef HS_SIDES
    hs_joinSides(covered, otherSide, step(HS_FOLD_AT, tags.ends), tags.firstSide);
#endif
    hs_foldCaster(visible, covered, step(HS_FOLD_AT, tags.ends));
    hs_lit += hs_takeSquare(visible, step(1.5, tags.ends));
    if (tags.ends > 2.5) break;
  }
#endif
#ifdef HS_CUTS
  HS_CutWalk cutWalk;
  hs_startCutWalk(cutWalk);
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
#ifdef HS_CASTING_RECEIVER
    if (!hs_listed) break;
#else
    if (!hs_among) break;
#endif
    HS_Tags tags;
    HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
#ifdef HS_TREES
    if (tags.tree > 0.5) {
      hs_walkTree(projected, tags.side, visible, cutWalk, covered);
    } else {
      hs_cutWalk(cutWalk, covered, projected, tags);
    }
#else
    hs_cutWalk(cutWalk, covered, projected, tags);
#endif
#ifdef HS_SIDES
    hs_joinSides(covered, otherSide, step(HS_FOLD_AT, tags.ends), tags.firstSide);
#endif
    hs_foldCaster(visible, covered, step(HS_FOLD_AT, tags.ends));
    hs_lit += hs_takeSquare(visible, step(1.5, tags.ends));
    if (tags.ends > 2.5) break;
  }
#endif
  return hs_lit;
}
