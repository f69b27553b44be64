// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Adds the edges of silhouette loops to what a caster occludes, vertex by vertex. Needs vbuffer_edges.glsl and
// list_vertices.glsl.

// `projected`, `tags`: of hs_nextVertex().
#ifndef HS_CASTING_RECEIVER
// For receivers behind every vertex.
struct HS_Walk {
  HS_HIGHP vec2 previous;
};
void hs_startWalk(out HS_Walk walk) { walk.previous = vec2(0.0); }
void hs_walk(inout HS_Walk walk, inout HS_Sums sums, HS_HIGHP vec3 projected, HS_Tags tags) {
  HS_HIGHP vec2 point = hs_onLight(projected);
  hs_addEdge(sums, mix(walk.previous, point, tags.starts), point);
  walk.previous = point;
}
#endif

#ifdef HS_CUTS
// Edges are cut where they pass the receiver's height; the ends are joined by chords far outside the light.
struct HS_CutWalk {
  HS_HIGHP vec3 previous;
  HS_HIGHP vec2 reached, firstReached;
  HS_HIGHP float begun;
#ifdef HS_ONE_SIDED
  HS_Sums oneSided;         // of the loop so far, if it is one-sided
  HS_HIGHP float offFacet;  // by how much a vertex of it lies off the receiver's own plane
#endif
};
void hs_startCutWalk(out HS_CutWalk walk) {
  walk.previous = vec3(0.0);
  walk.reached = walk.firstReached = vec2(0.0);
  walk.begun = 0.0;
#ifdef HS_ONE_SIDED
  hs_clearSums(walk.oneSided);
  walk.offFacet = 0.0;
#endif
}
void hs_cutWalk(inout HS_CutWalk walk, inout HS_Sums sums, HS_HIGHP vec3 projected, HS_Tags tags) {
  walk.begun *= 1.0 - tags.starts;
  HS_HIGHP vec3 cutFrom, cutTo;
  bool seen = hs_cutEdge(walk.previous, projected, tags.starts, cutFrom, cutTo);
  HS_HIGHP vec2 from = hs_onLight(cutFrom), to = hs_onLight(cutTo);
  if (seen && walk.begun < 0.5) {
    walk.firstReached = from;
    walk.reached = from;
    walk.begun = 1.0;
  }
#ifdef HS_ONE_SIDED
  walk.offFacet = max(walk.offFacet * (1.0 - tags.starts), hs_offFacet(projected) / tags.coarse);
  bool twoSided = tags.oneSided < 0.5;
  HS_Sums parts = walk.oneSided;
  if (twoSided) parts = sums;
  hs_addFarChord(parts, walk.reached, seen ? from : walk.reached);
  hs_addEdge(parts, seen ? from : to, to);
  walk.reached = seen ? to : walk.reached;
  hs_addFarChord(parts, walk.reached, walk.begun * tags.closes > 0.5 ? walk.firstReached : walk.reached);
  if (twoSided) {
    sums = parts;
  } else {
    walk.oneSided = parts;
    if (tags.closes > 0.5) {
      // A facet hides nothing from itself.
      bool counts = hs_facetRounding <= 0.0 || walk.offFacet > hs_facetRounding;
      if (counts && hs_wayRound(parts) > 0.0) hs_addSums(sums, parts);
      hs_clearSums(walk.oneSided);
    }
  }
#else
  hs_addFarChord(sums, walk.reached, seen ? from : walk.reached);
  hs_addEdge(sums, seen ? from : to, to);
  walk.reached = seen ? to : walk.reached;
  hs_addFarChord(sums, walk.reached, walk.begun * tags.closes > 0.5 ? walk.firstReached : walk.reached);
#endif
  walk.previous = projected;
}
#endif
