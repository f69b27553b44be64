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

#if defined(HS_TREES) && defined(HS_CUTS)
HS_HIGHP vec4 hs_bits(HS_HIGHP float number) { return step(0.5, mod(floor(number / vec4(1.0, 2.0, 4.0, 8.0)), 2.0)); }

// What the trees leave that the list begins with; of what they leave of sub-lights without records the sum goes to hs_lit.
// Moves on to the first record of something else; false: there is none.
HS_Grid hs_leftByTrees(inout HS_HIGHP vec2 at, HS_HIGHP vec3 origin, inout bool listed) {
  HS_Grid left = hs_grid(1.0), covered = hs_grid(0.0);
#ifdef HS_SIDES
  HS_Grid firstSide = hs_grid(0.0);
#endif
  bool treed = false;
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!listed) break;
    HS_Tags tags;
    HS_HIGHP vec2 next = at;
    HS_HIGHP vec3 address = hs_nextVertex(next, origin, tags);
    if (tags.tree < 0.5) break;
    treed = true;
    at = next;
#ifdef HS_WHOLE_LIGHT
    HS_HIGHP vec4 subLights = vec4(1.0);
#else
    HS_HIGHP vec4 subLights = hs_bits(tags.subLights);
#endif
    hs_walkTree(address, hs_ofSubLights(left, subLights), covered);
    HS_HIGHP float ends = step(0.5, tags.ends);
#ifdef HS_SIDES
    hs_joinGrids(covered, firstSide, ends, tags.firstSide);
#endif
    hs_foldGrid(left, covered, ends * subLights);
    if (ends > 0.5) covered = hs_grid(0.0);
    listed = tags.ends < 2.5;
  }
#ifdef HS_WHOLE_LIGHT
  if (treed) hs_lit = min(hs_lit, 1.0) * dot(hs_quartersOf(left), vec4(0.25));
#else
  if (treed) hs_lit = dot(hs_bits(hs_lit), hs_quartersOf(left));
#endif
  return left;
}
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
#ifdef HS_CASTING_RECEIVER
  bool cut = hs_listed;
#else
  bool cut = hs_among;
#endif
#ifdef HS_TREES
  HS_Grid left = hs_leftByTrees(at, origin, cut);
  // Nothing is left for the list's other casters to hide.
  cut = cut && !hs_hidesAll(left, hs_grid(0.0));
#endif
  HS_CutWalk cutWalk;
  hs_startCutWalk(cutWalk);
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!cut) break;
    HS_Tags tags;
    HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
    hs_cutWalk(cutWalk, covered, projected, tags);
#ifdef HS_SIDES
    hs_joinSides(covered, otherSide, step(HS_FOLD_AT, tags.ends), tags.firstSide);
#endif
    hs_foldCaster(visible, covered, step(HS_FOLD_AT, tags.ends));
#ifdef HS_TREES
    hs_foldQuarters(visible, hs_cellsOfSide(left, tags.side), step(1.5, tags.ends));
#endif
    hs_lit += hs_takeSquare(visible, step(1.5, tags.ends));
    if (tags.ends > 2.5) break;
  }
#endif
  return hs_limitedLight(hs_lit);
}
