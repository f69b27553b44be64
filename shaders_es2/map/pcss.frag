// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer soft shadows: a blocker search over the region that could hold blockers, the penumbra's
// width from similar triangles in reciprocal depth, a filter of that width.
// Based on: Fernando, "Percentage-Closer Soft Shadows", 2005.
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
#include "map/blocker_search.glsl"

HS_HIGHP vec2 hs_penumbraWidth() {
  HS_HIGHP vec2 found = hs_searchBlockers();
  if (found.x <= 0.0) return vec2(-1.0);
#ifndef HS_SUB_LIGHTS_U
  if (found.x >= 1.0) return vec2(-2.0);
#endif
  return hs_kernel * found.y;
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
