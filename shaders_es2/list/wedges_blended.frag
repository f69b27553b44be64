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
#include "map/half_plane.glsl"
#include "list/caster_lists.glsl"
#include "list/vbuffer_walk.glsl"
#include "list/facet_tree.glsl"
#include "list/blended_lists.glsl"

float halfshadow_class() {
  hs_findList();
  return hs_listed ? -1.0 : hs_limitedLight(hs_lit);
}

float halfshadow_visibility() {
#ifdef HS_CASTING_RECEIVER
  return hs_blendedOwn();
#else
  hs_findList();
  HS_HIGHP vec2 at;
  HS_HIGHP vec3 origin = hs_enterList(at);
  HS_HIGHP float lit = hs_lit;
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
#if defined(HS_HALF) && HS_HALF == 1
  lit = 1.0;  // the other half tells
#endif
  return blended ? 1.0 - dot(all.share, HS_Quads(0.25)) : lit;
#endif
}
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
