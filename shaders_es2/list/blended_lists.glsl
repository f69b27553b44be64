// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Walks the list of the fragment's tile, and merges into what the casters before hide what each one hides. Needs
// caster_lists.glsl, vbuffer_walk.glsl and facet_tree.glsl.
// Based on: Forest, Barthe, Paulin 2006, section 3.
#ifdef HS_SIDES
// What a sheet hides is that side of it which hides more: `firstSide` keeps the one that ends first.
void hs_mergeSide(inout HS_Occlusion hidden, inout HS_Occlusion firstSide, HS_Occlusion side, HS_HIGHP float isFirst) {
  HS_Occlusion both = hs_largerOf(firstSide, side);
  firstSide = hs_nothing();
  if (isFirst > 0.5) {
    firstSide = both;
  } else {
    hidden = hs_merge(hidden, both);
  }
}
#endif

#ifndef HS_CASTING_RECEIVER
// Nothing to blend where no casters overlap: their shares of the whole light.
HS_HIGHP float hs_sumOfShares(HS_HIGHP vec2 at, HS_HIGHP vec3 origin) {
  HS_HIGHP float share = 0.0;
  HS_HIGHP vec2 last = vec2(0.0);
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!hs_apart) break;
    HS_Tags tags;
    HS_HIGHP vec2 point = hs_onLight(hs_nextVertex(at, origin, tags));
    share += hs_edgeShare(mix(last, point, tags.starts), point);
    last = point;
    if (tags.ends > 2.5) break;
  }
  return clamp(share, 0.0, 1.0);
}

HS_Occlusion hs_blended(HS_HIGHP vec2 at, HS_HIGHP vec3 origin, bool listed) {
  HS_Occlusion all = hs_nothing();
  HS_HIGHP float ends = listed ? 0.0 : 3.0;
#ifdef HS_SIDES
  HS_Occlusion firstSide = hs_nothing();
#endif
  for (HS_HIGHP int caster = 0; caster < HS_LONGEST_LIST; ++caster) {
    if (ends > 2.5) break;
    HS_Sums sums;
    hs_clearSums(sums);
#ifdef HS_SIDES
    HS_HIGHP float sideEnds = 0.0;
#endif
    HS_Walk walk;
    hs_startWalk(walk);
    for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
      HS_Tags tags;
      HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
      ends = tags.ends;
#ifdef HS_SIDES
      sideEnds = tags.firstSide;
#endif
      hs_walk(walk, sums, projected, tags);
      if (ends > 0.5) break;
    }
#ifdef HS_SIDES
    hs_mergeSide(all, firstSide, hs_occlusion(sums), sideEnds);
#else
    all = hs_merge(all, hs_occlusion(sums));
#endif
  }
  return all;
}
#endif

#if defined(HS_TREES) && defined(HS_CUTS)
// Adds what the trees hide that the list begins with. Moves on to the first record of something else; not `listed`: there
// is none.
void hs_hideByTrees(inout HS_HIGHP vec2 at, HS_HIGHP vec3 origin, inout bool listed, inout HS_Occlusion hidden) {
#ifdef HS_SIDES
  HS_Occlusion firstSide = hs_nothing();
#endif
  HS_Sums sums;
  hs_clearSums(sums);
  for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!listed) break;
    HS_Tags tags;
    HS_HIGHP vec2 next = at;
    HS_HIGHP vec3 address = hs_nextVertex(next, origin, tags);
    if (tags.tree < 0.5) break;
    at = next;
    hs_walkTree(address, hidden, sums);
    if (tags.ends > 0.5) {
#ifdef HS_SIDES
      hs_mergeSide(hidden, firstSide, hs_occlusion(sums), tags.firstSide);
#else
      hidden = hs_merge(hidden, hs_occlusion(sums));
#endif
      hs_clearSums(sums);
    }
    listed = tags.ends < 2.5;
  }
}
#endif

#ifdef HS_CUTS
HS_Occlusion hs_blendedAmong(HS_HIGHP vec2 at, HS_HIGHP vec3 origin, bool listed, HS_Occlusion hidden) {
#ifdef HS_TREES
  // Walked before all else: some devices take both sides of a branch, and would walk trees with every vertex.
  hs_hideByTrees(at, origin, listed, hidden);
#endif
  HS_HIGHP float ends = listed ? 0.0 : 3.0;
#ifdef HS_SIDES
  HS_Occlusion firstSide = hs_nothing();
#endif
  for (HS_HIGHP int caster = 0; caster < HS_LONGEST_LIST; ++caster) {
    if (ends > 2.5) break;
#ifdef HS_TREES
    // What is hidden wholly stays so.
    if (all(greaterThanEqual(hidden.share, HS_Quads(1.0)))) break;
#endif
    HS_Sums sums;
    hs_clearSums(sums);
#ifdef HS_SIDES
    HS_HIGHP float sideEnds = 0.0;
#endif
    HS_CutWalk walk;
    hs_startCutWalk(walk);
    for (HS_HIGHP int i = 0; i < HS_LONGEST_LIST; ++i) {
      HS_Tags tags;
      HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
      hs_cutWalk(walk, sums, projected, tags);
      ends = tags.ends;
#ifdef HS_SIDES
      sideEnds = tags.firstSide;
#endif
      if (ends > 0.5) break;
    }
#ifdef HS_SIDES
    hs_mergeSide(hidden, firstSide, hs_occlusion(sums), sideEnds);
#else
    hidden = hs_merge(hidden, hs_occlusion(sums));
#endif
  }
  return hidden;
}
#endif

#ifdef HS_CASTING_RECEIVER
// Visibility of the fragment, which may lie among its list's casters.
HS_HIGHP float hs_blendedOwn() {
  hs_findList();
  HS_HIGHP vec2 at;
  HS_HIGHP vec3 origin = hs_enterList(at);
  bool blended = hs_listed;
  HS_Occlusion all = hs_blendedAmong(at, origin, blended, hs_nothing());
#if defined(HS_HALF) && HS_HALF == 1
  hs_lit = 1.0;  // the other half tells
#endif
#if defined(HS_LIMITED) && !defined(HS_HALF)
  // Row by row, as the halves do.
  HS_HIGHP vec2 rows = 0.5 - 0.25 * (all.share.xz + all.share.yw);
  rows = min(rows, 0.5 * vec2(hs_shareBefore(hs_lightRow(0.0)), hs_shareBefore(hs_lightRow(1.0))));
  return blended ? rows.x + rows.y : hs_limitedLight(hs_lit);
#else
  return hs_limitedLight(blended ? 1.0 - dot(all.share, HS_Quads(0.25)) : hs_lit);
#endif
}
#endif
