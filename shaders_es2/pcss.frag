// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer soft shadows: a blocker search over the region that could hold blockers, the penumbra's
// width from similar triangles in reciprocal depth, a filter of that width.
// Based on: Fernando, "Percentage-Closer Soft Shadows", 2005.
#include "tap_count.glsl"
#include "depth_storage.glsl"
#include "receiver_inputs.glsl"
#include "shadow_tap.glsl"
#include "kernel_spread.glsl"
#include "block_mask.glsl"
#include "blocker_search.glsl"
// xy: kernel width in texels per unit of depth difference, z: depth of the nearest caster
uniform HS_HIGHP vec4 u_penumbra;

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
  // The nearest caster around bounds the region to search.
  HS_HIGHP vec2 width = u_penumbra.xy * (hs_receiverValue - hs_nearestAround());
  if (hs_lightMisses || width.x <= 0.0) return 1.0;
  HS_HIGHP vec2 found = hs_searchBlockers(width);
  if (found.x <= 0.0) return 1.0;
  if (found.x >= 1.0) return 0.0;
  return hs_pcfSpread(max(u_penumbra.xy * found.y, vec2(1.0)));
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
#endif
