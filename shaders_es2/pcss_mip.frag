// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer soft shadows whose blocker search is two fetches of an occupancy pyramid: one over the
// widest region that could hold a blocker, one over the region that the first answer leaves.
#include "tap_count.glsl"
#include "depth_storage.glsl"
#include "receiver_inputs.glsl"
#include "shadow_tap.glsl"
#include "kernel_spread.glsl"
#include "blocker_pyramid.glsl"
#include "block_mask.glsl"
#ifdef HS_CASTING_RECEIVER
#include "blocker_search.glsl"
#endif
uniform HS_HIGHP vec4 u_penumbra;

// Width of the penumbra in texels, or -1: lit.
HS_HIGHP float hs_penumbraWidth() {
#ifdef HS_CASTING_RECEIVER
  // A receiver that is in the map would take its own surface for a blocker in any mean over a region.
  HS_HIGHP float widest = u_penumbra.x * (hs_receiverValue - hs_nearestAround());
  if (hs_lightMisses || widest <= 0.0) return -1.0;
  HS_HIGHP vec2 found = hs_searchBlockers(vec2(widest, widest * u_penumbra.y / u_penumbra.x));
  return found.x > 0.0 ? u_penumbra.x * found.y : -1.0;
#else
  HS_HIGHP float widest = u_penumbra.x * (hs_receiverValue - u_penumbra.z);
  if (hs_lightMisses || widest <= 0.0) return -1.0;
  HS_HIGHP vec2 coarse = hs_occupancy(hs_texel, widest);
  if (coarse.x <= 0.5 / 255.0) return -1.0;
  HS_HIGHP float gap = max(hs_receiverValue - hs_meanBlockerDepth(coarse), 0.0);
  HS_HIGHP vec2 fine = hs_occupancy(hs_texel, max(u_penumbra.x * gap, 1.0) * 1.25);
  if (fine.x > 0.5 / 255.0) gap = max(hs_receiverValue - hs_meanBlockerDepth(fine), 0.0);
  return u_penumbra.x * gap;
#endif
}

float halfshadow_class() {
  hs_prepare();
  return hs_maskClass();
}

float halfshadow_visibility() {
  hs_prepare();
#ifndef HS_PHASE_FILTER
  float known = hs_maskClass();
  if (known > -0.5) return known;
#endif
  HS_HIGHP float width = hs_penumbraWidth();
  if (width < 0.0) return 1.0;
  return hs_pcfSpread(max(vec2(width, width * u_penumbra.y / u_penumbra.x), vec2(1.0)));
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
#endif
