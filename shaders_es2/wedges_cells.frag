// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Walks the silhouette vertices that matter for the fragment's tile: four sub-lights, each with silhouettes of
// its own; per caster the covered share of each light cell, over casters their product.
#include "tap_count.glsl"
#include "cell_coverage.glsl"
#define HS_SUB_LIGHTS 4.0
#include "caster_lists.glsl"

// Where a vertex projects onto the light, relative to the sub-light's centre, in its half sides.
HS_HIGHP vec2 hs_onSubLight(HS_HIGHP vec3 projected, HS_HIGHP vec2 side) {
  return 2.0 * hs_onLight(projected) - side;
}

float halfshadow_class() {
  hs_findList();
  return hs_listed ? -1.0 : 0.25 * hs_lit;
}

float halfshadow_visibility() {
  hs_findList();
  HS_HIGHP vec2 at = hs_firstVertex();
  HS_HIGHP vec3 origin = hs_listOrigin();
#ifdef HS_CASTING_RECEIVER
  HS_HIGHP vec3 previous = vec3(0.0);
  HS_HIGHP vec2 reached = vec2(0.0), firstReached = vec2(0.0);
  HS_HIGHP float begun = 0.0;
#else
  HS_HIGHP vec2 previous = vec2(0.0);
#endif
  HS_Cells visible = HS_CELLS_ALL(1.0);
  HS_Cells covered = HS_CELLS_ALL(0.0);
  for (int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!hs_listed) break;
    HS_Tags tags;
    HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
#ifdef HS_CASTING_RECEIVER
    // Edges are cut where they pass the receiver's height; the ends are joined by chords far outside the light.
    begun *= 1.0 - tags.starts;
    HS_HIGHP float before = tags.starts > 0.5 ? -1.0 : previous.z - HS_NEAR, now = projected.z - HS_NEAR;
    HS_HIGHP vec3 cut = mix(previous, projected, before / (abs(before - now) < 1e-9 ? 1e-9 : before - now));
    bool crosses = before * now < 0.0 && tags.starts < 0.5;
    bool seen = max(before, now) > 0.0;
    HS_HIGHP vec2 from = hs_onSubLight(before > 0.0 ? previous : (crosses ? cut : projected), tags.side);
    HS_HIGHP vec2 to = hs_onSubLight(now > 0.0 ? projected : cut, tags.side);
    if (seen && begun < 0.5) {
      firstReached = from;
      reached = from;
      begun = 1.0;
    }
    // An edge that starts a loop has no length: from = to.
    hs_addFarChord(covered, reached, from, seen ? 1.0 : 0.0);
    hs_addEdge(covered, seen ? from : to, to);
    reached = seen ? to : reached;
    hs_addFarChord(covered, reached, firstReached, begun * tags.closes);
    previous = projected;
#else
    HS_HIGHP vec2 point = hs_onSubLight(projected, tags.side);
    hs_addEdge(covered, mix(previous, point, tags.starts), point);
    previous = point;
#endif
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
