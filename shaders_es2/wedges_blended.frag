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
#include "vbuffer_walk.glsl"

float halfshadow_class() {
  hs_findList();
  return hs_listed ? -1.0 : hs_lit;
}

#ifndef HS_CASTING_RECEIVER
// Nothing to blend where no casters overlap: their shares of the whole light.
HS_HIGHP float hs_sumOfShares(HS_HIGHP vec3 origin) {
  HS_HIGHP float share = 0.0;
  HS_HIGHP vec2 last = vec2(0.0), at = hs_firstVertex();
  for (int i = 0; i < HS_LONGEST_LIST; ++i) {
    if (!hs_apart) break;
    HS_Tags tags;
    HS_HIGHP vec2 point = hs_onLight(hs_nextVertex(at, origin, tags));
    share += hs_edgeShare(mix(last, point, tags.starts), point);
    last = point;
    if (tags.ends > 2.5) break;
  }
  return clamp(share, 0.0, 1.0);
}
#endif

float halfshadow_visibility() {
  hs_findList();
  HS_HIGHP vec3 origin = hs_listOrigin();
  HS_HIGHP float lit = hs_lit;
#ifndef HS_CASTING_RECEIVER
  HS_HIGHP float sumOfShares = hs_sumOfShares(origin);
  if (hs_apart) lit = 1.0 - sumOfShares;
  bool blended = hs_listed && !hs_apart;
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
    HS_Walk walk;
    hs_startWalk(walk);
    for (int i = 0; i < HS_LONGEST_LIST; ++i) {
      HS_Tags tags;
      HS_HIGHP vec3 projected = hs_nextVertex(at, origin, tags);
      ends = tags.ends;
      hs_walk(walk, sums, projected, tags);
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
