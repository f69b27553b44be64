// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Adds the edges of silhouette loops to light cells, vertex by vertex. Needs cell_coverage.glsl and
// list_vertices.glsl.

// Where a vertex projects onto the light, relative to the sub-light's centre, in its half sides.
HS_HIGHP vec2 hs_onSubLight(HS_HIGHP vec3 projected, HS_HIGHP vec2 side) {
#ifdef HS_WHOLE_LIGHT
  return hs_onLight(projected);
#else
  return 2.0 * hs_onLight(projected) - side;
#endif
}

// `projected`, `tags`: of hs_nextVertex().
#ifndef HS_CASTING_RECEIVER
// For receivers behind every vertex.
struct HS_Walk {
  HS_HIGHP vec2 previous;
};
void hs_startWalk(out HS_Walk walk) { walk.previous = vec2(0.0); }
void hs_walk(inout HS_Walk walk, inout HS_Cells covered, HS_HIGHP vec3 projected, HS_Tags tags) {
  HS_HIGHP vec2 point = hs_onSubLight(projected, tags.side);
  hs_addEdge(covered, mix(walk.previous, point, tags.starts), point);
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
  HS_Cells oneSided;      // what the loop covers so far, if it is one-sided
  HS_HIGHP float offFacet;  // by how much a vertex of it lies off the receiver's own plane
#endif
};
void hs_startCutWalk(out HS_CutWalk walk) {
  walk.previous = vec3(0.0);
  walk.reached = walk.firstReached = vec2(0.0);
  walk.begun = 0.0;
#ifdef HS_ONE_SIDED
  walk.oneSided = HS_CELLS_ALL(0.0);
  walk.offFacet = 0.0;
#endif
}
void hs_cutWalk(inout HS_CutWalk walk, inout HS_Cells covered, HS_HIGHP vec3 projected, HS_Tags tags) {
  walk.begun *= 1.0 - tags.starts;
  HS_HIGHP vec3 cutFrom, cutTo;
  bool seen = hs_cutEdge(walk.previous, projected, tags.starts, cutFrom, cutTo);
  HS_HIGHP vec2 from = hs_onSubLight(cutFrom, tags.side), to = hs_onSubLight(cutTo, tags.side);
  if (seen && walk.begun < 0.5) {
    walk.firstReached = from;
    walk.reached = from;
    walk.begun = 1.0;
  }
  // An edge that starts a loop has no length: from = to.
#ifdef HS_ONE_SIDED
  HS_Cells part = HS_CELLS_ALL(0.0);
  hs_addFarChord(part, walk.reached, from, seen ? 1.0 : 0.0);
  hs_addEdge(part, seen ? from : to, to);
  walk.reached = seen ? to : walk.reached;
  hs_addFarChord(part, walk.reached, walk.firstReached, walk.begun * tags.closes);
  // A facet hides nothing from itself.
  walk.offFacet = max(walk.offFacet * (1.0 - tags.starts), hs_offFacet(projected) / tags.coarse);
  HS_HIGHP float counts = hs_facetRounding > 0.0 ? step(hs_facetRounding, walk.offFacet) : 1.0;
  hs_addPart(covered, walk.oneSided, part, tags.oneSided, tags.closes, counts);
#else
  hs_addFarChord(covered, walk.reached, from, seen ? 1.0 : 0.0);
  hs_addEdge(covered, seen ? from : to, to);
  walk.reached = seen ? to : walk.reached;
  hs_addFarChord(covered, walk.reached, walk.firstReached, walk.begun * tags.closes);
#endif
  walk.previous = projected;
}
#endif
