// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer soft shadows whose blocker search is one look into an occupancy pyramid, over the widest region
// that could hold a blocker, and a second one where the first answer leaves much less of it.
#include "receiver/tap_count.glsl"
#include "map/depth_storage.glsl"
#include "receiver/receiver_inputs.glsl"
#include "map/shadow_tap.glsl"
#include "map/half_plane.glsl"
#include "map/horizon.glsl"
#include "map/spread_few.glsl"
#include "map/spread_places.glsl"
#include "map/spread_taps.glsl"
#include "map/kernel_spread.glsl"
#include "map/penumbra_bounds.glsl"
#include "map/occupancy_storage.glsl"
#include "map/blocker_pyramid.glsl"
#if defined(HS_CASTING_RECEIVER) || defined(HS_SHORT)
#include "map/blocker_search.glsl"
#endif

HS_HIGHP vec2 hs_penumbraWidth() {
#if defined(HS_CASTING_RECEIVER) || defined(HS_SHORT)
  // A receiver that is in the map would take its own surface for a blocker in any mean over a region.
  HS_HIGHP vec2 found = hs_searchBlockers();
  return found.x > 0.0 ? hs_kernel * found.y : vec2(-1.0);
#else
  HS_HIGHP float gap = hs_meanGap();
  return gap >= 0.0 ? hs_kernel * gap : vec2(-1.0);
#endif
}

float hs_filter(HS_HIGHP vec2 width) { return hs_pcfSpread(max(width, vec2(HS_NARROWEST))); }
#include "map/sub_light_taps.glsl"
#include "map/penumbra_main.glsl"
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
