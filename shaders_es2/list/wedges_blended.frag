// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Forest's blending of penumbrae, gathered: caster by caster the occluded share, rectangle and centre of gravity of
// each quadrant, merged into those of the casters before. Both vBuffers are registers. HS_HALF: of one row of quadrants;
// what the two rows hide adds up.
// Based on: Forest, Barthe, Paulin 2006, section 3.
#include "receiver/tap_count.glsl"
#include "list/vbuffer_edges.glsl"
#include "list/vbuffer_merge.glsl"
#include "list/list_vertices.glsl"
#define HS_SUB_LIGHTS 1.0
#include "list/caster_lists.glsl"
#include "list/vbuffer_walk.glsl"
#include "list/facet_tree.glsl"

float halfshadow_class() {
  hs_findList();
  return hs_listed ? -1.0 : hs_lit;
}

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
    HS_Occlusion both = hs_largerOf(firstSide, hs_occlusion(sums));
    firstSide = hs_nothing();
    if (sideEnds > 0.5) {
      firstSide = both;
    } else {
      all = hs_merge(all, both);
    }
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
      HS_Occlusion both = hs_largerOf(firstSide, hs_occlusion(sums));
      firstSide = hs_nothing();
      if (tags.firstSide > 0.5) {
        firstSide = both;
      } else {
        hidden = hs_merge(hidden, both);
      }
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
    HS_Occlusion both = hs_largerOf(firstSide, hs_occlusion(sums));
    firstSide = hs_nothing();
    if (sideEnds > 0.5) {
      firstSide = both;
    } else {
      hidden = hs_merge(hidden, both);
    }
#else
    hidden = hs_merge(hidden, hs_occlusion(sums));
#endif
  }
  return hidden;
}
#endif

float halfshadow_visibility() {
  hs_findList();
  HS_HIGHP vec2 at;
  HS_HIGHP vec3 origin = hs_enterList(at);
  HS_HIGHP float lit = hs_lit;
#ifdef HS_CASTING_RECEIVER
  bool blended = hs_listed;
  HS_Occlusion all = hs_blendedAmong(at, origin, blended, hs_nothing());
#else
#if !defined(HS_HALF) || HS_HALF == 0
  HS_HIGHP float sumOfShares = hs_sumOfShares(at, origin);
  if (hs_apart) lit = 1.0 - sumOfShares;
#endif
  bool blended = hs_listed && !hs_apart;
#ifdef HS_AMONG_RECEIVERS
  HS_Occlusion all = hs_blended(at, origin, blended && !hs_among);
  all = hs_blendedAmong(at, origin, hs_among, all);
#else
  HS_Occlusion all = hs_blended(at, origin, blended);
#endif
#endif
#if defined(HS_HALF) && HS_HALF == 1
  lit = 1.0;  // the other half tells
#endif
  return blended ? 1.0 - dot(all.share, HS_Quads(0.25)) : lit;
}
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
