// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Forest's blending of penumbrae, gathered: caster by caster the occluded share, rectangle and centre of gravity of
// each quadrant, merged into those of the casters before. Both vBuffers are registers.
// Based on: Forest, Barthe, Paulin 2006, section 3.
#include "tap_count.glsl"
#include "vbuffer_edges.glsl"
#include "vbuffer_merge.glsl"
#include "list_vertices.glsl"
#define HS_SUB_LIGHTS 1.0
#include "caster_lists.glsl"

float halfshadow_class() {
  hs_findList();
  return hs_listed ? -1.0 : hs_lit;
}

#ifndef HS_CASTING_RECEIVER
// Nothing to blend where there is one caster: its share of the whole light.
HS_HIGHP float hs_shareOfOne(HS_HIGHP vec3 origin) {
  HS_HIGHP float share = 0.0;
  HS_HIGHP vec2 last = vec2(0.0), at = hs_firstVertex();
  for (int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!hs_single) break;
    HS_Tags tags;
    HS_HIGHP vec2 point = hs_onLight(hs_nextVertex(at, origin, tags));
    share += hs_edgeShare(mix(last, point, tags.starts), point);
    last = point;
    if (tags.ends > 0.5) break;
  }
  return clamp(share, 0.0, 1.0);
}
#endif

float halfshadow_visibility() {
  hs_findList();
  HS_HIGHP vec3 origin = hs_listOrigin();
  HS_HIGHP float lit = hs_lit;
#ifndef HS_CASTING_RECEIVER
  HS_HIGHP float shareOfOne = hs_shareOfOne(origin);
  if (hs_single) lit = 1.0 - shareOfOne;
  bool blended = hs_listed && !hs_single;
#else
  bool blended = hs_listed;
#endif
  HS_HIGHP vec2 at = hs_firstVertex();
  HS_Occlusion all = hs_nothing();
  HS_HIGHP float ends = blended ? 0.0 : 3.0;
  for (int caster = 0; caster < HS_LONGEST_LIST; ++caster) {
    if (ends > 2.5) break;
    HS_Sums sums;
    hs_clearSums(sums);
#ifdef HS_CASTING_RECEIVER
    HS_HIGHP vec3 previous = vec3(0.0);
    HS_HIGHP vec2 reached = vec2(0.0), firstReached = vec2(0.0);
    HS_HIGHP float begun = 0.0;
#else
    HS_HIGHP vec2 previous = vec2(0.0);
#endif
    for (int i = 0; i < HS_LONGEST_LIST; ++i) {
      HS_Tags tags;
      HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
      ends = tags.ends;
#ifdef HS_CASTING_RECEIVER
      // Edges are cut where they pass the receiver's height; the ends are joined by chords far outside the light.
      begun *= 1.0 - tags.starts;
      HS_HIGHP float before = tags.starts > 0.5 ? -1.0 : previous.z - HS_NEAR, now = projected.z - HS_NEAR;
      HS_HIGHP vec3 cut =
          mix(previous, projected, before / (abs(before - now) < 1e-9 ? 1e-9 : before - now));
      bool crosses = before * now < 0.0 && tags.starts < 0.5;
      bool seen = max(before, now) > 0.0;
      HS_HIGHP vec2 from = hs_onLight(before > 0.0 ? previous : (crosses ? cut : projected));
      HS_HIGHP vec2 to = hs_onLight(now > 0.0 ? projected : cut);
      if (seen && begun < 0.5) {
        firstReached = from;
        reached = from;
        begun = 1.0;
      }
      hs_addFarChord(sums, reached, seen ? from : reached);
      hs_addEdge(sums, seen ? from : to, to);
      reached = seen ? to : reached;
      hs_addFarChord(sums, reached, begun * tags.closes > 0.5 ? firstReached : reached);
      previous = projected;
#else
      HS_HIGHP vec2 point = hs_onLight(projected);
      hs_addEdge(sums, mix(previous, point, tags.starts), point);
      previous = point;
#endif
      if (ends > 0.5) break;
    }
    all = hs_merge(all, hs_occlusion(sums));
  }
  return blended ? 1.0 - dot(all.share, vec4(0.25)) : lit;
}
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
