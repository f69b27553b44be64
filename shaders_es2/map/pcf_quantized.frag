// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Variable penumbrae by bands of the penumbra's width W in texels: the mean blocker of the neighbourhood gives W,
// W falls into one of few bands, each band has one kernel, spread over the band's width.
// Based on: Evans, Agenjo, Blat 2014, section 4.4, with widths in reciprocal depth instead of edge strengths.
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
uniform HS_HIGHP vec4 u_bands;    // x: log2 of the narrowest band's width, y: bands per octave, z: last band
uniform HS_HIGHP vec4 u_kernels;  // sides of the three kernels, narrow to wide

HS_HIGHP vec2 hs_penumbraWidth() {
  HS_HIGHP float widest = max(hs_kernel.x, hs_kernel.y);
#if defined(HS_CASTING_RECEIVER) || defined(HS_SHORT)
  // A receiver that is in the map would take its own surface for a blocker in any mean over a region.
  HS_HIGHP vec2 found = hs_searchBlockers();
  if (found.x <= 0.0) return vec2(-1.0);
  HS_HIGHP float width = widest * found.y;
#else
  HS_HIGHP float width = widest * hs_meanGap();
  if (width < 0.0) return vec2(-1.0);
#endif
  HS_HIGHP float band = clamp(floor((log2(max(width, 0.01)) - u_bands.x) * u_bands.y + 0.5), 0.0, u_bands.z);
  return hs_kernel * (exp2(u_bands.x + band / u_bands.y) / widest);
}

float hs_filter(HS_HIGHP vec2 width) {
  // A texel a tap: more taps than that read the same texels again.
  HS_HIGHP float widest = max(width.x, width.y);
  HS_HIGHP float side = widest < u_kernels.x ? u_kernels.x : (widest < u_kernels.y ? u_kernels.y : u_kernels.z);
  return hs_spreadSum(max(width, vec2(1.0)), side, hs_spreadBias());
}
#include "map/sub_light_taps.glsl"
#include "map/penumbra_main.glsl"
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
