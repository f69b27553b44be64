// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer soft shadows whose blocker search is one look into an occupancy pyramid, over the widest region
// that could hold a blocker, and a second one where the first answer leaves much less of it.
#include "receiver/tap_count.glsl"
#include "map/depth_storage.glsl"
#include "receiver/receiver_inputs.glsl"
#include "map/shadow_tap.glsl"
#include "map/sub_lights.glsl"
#include "map/horizon.glsl"
#include "map/kernel_spread.glsl"
#include "map/penumbra_bounds.glsl"
#include "map/occupancy_storage.glsl"
#include "map/blocker_pyramid.glsl"
#ifdef HS_CASTING_RECEIVER
#include "map/blocker_search.glsl"
#endif

// Width of the penumbra in texels along both axes, or -1: lit.
HS_HIGHP vec2 hs_penumbraWidth() {
#ifdef HS_CASTING_RECEIVER
  // A receiver that is in the map would take its own surface for a blocker in any mean over a region.
  HS_HIGHP vec2 found = hs_searchBlockers();
  return found.x > 0.0 ? u_penumbra.xy * found.y : vec2(-1.0);
#else
  return u_penumbra.xy * hs_meanGap();
#endif
}

float hs_filteredVisibility() {
  HS_HIGHP vec2 width = hs_penumbraWidth();
  if (width.x < 0.0) return 1.0;
  return hs_pcfSpread(max(width, vec2(1.0)));
}
#include "map/penumbra_main.glsl"
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/receiver_main.glsl"
#endif
