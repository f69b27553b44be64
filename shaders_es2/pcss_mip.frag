// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer soft shadows whose blocker search is two fetches of an occupancy pyramid: one over the
// widest region that could hold a blocker, one over the region that the first answer leaves.
#include "tap_count.glsl"
#include "depth_storage.glsl"
#include "receiver_inputs.glsl"
#include "shadow_tap.glsl"
#include "kernel_spread.glsl"
#include "penumbra_bounds.glsl"
#include "occupancy_storage.glsl"
#include "blocker_pyramid.glsl"
#ifdef HS_CASTING_RECEIVER
#include "blocker_search.glsl"
#endif

// Width of the penumbra in texels along both axes, or -1: lit.
HS_HIGHP vec2 hs_penumbraWidth() {
#ifdef HS_CASTING_RECEIVER
  // A receiver that is in the map would take its own surface for a blocker in any mean over a region.
  HS_HIGHP vec2 found = hs_searchBlockers();
  return found.x > 0.0 ? u_penumbra.xy * found.y : vec2(-1.0);
#else
  HS_HIGHP float widest = max(u_penumbra.x, u_penumbra.y);
  HS_HIGHP vec2 coarse = hs_blockersNear(widest * hs_widestGap);
  if (coarse.x <= 0.0) return vec2(-1.0);
  HS_HIGHP float gap = coarse.y / coarse.x;
  HS_HIGHP vec2 fine = hs_blockersAround(max(widest * gap, 1.0) * 1.25);
  if (fine.x > 0.0) gap = fine.y / fine.x;
  return u_penumbra.xy * gap;
#endif
}

float halfshadow_class() {
  hs_prepare();
  return hs_maskClass();
}

float halfshadow_visibility() {
  hs_prepare();
  float known = hs_maskClass();
  if (known > -0.5) return known;
  HS_HIGHP vec2 width = hs_penumbraWidth();
  if (width.x < 0.0) return 1.0;
  return hs_pcfSpread(max(width, vec2(1.0)));
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
#endif
