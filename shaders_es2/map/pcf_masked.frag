// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "receiver/tap_count.glsl"
#include "map/depth_storage.glsl"
#include "receiver/receiver_inputs.glsl"
#include "map/shadow_tap.glsl"
#ifdef HS_POISSON_COUNT
#include "map/kernel_poisson.glsl"
#define hs_pcf hs_pcfPoisson
#else
#include "map/kernel_grid.glsl"
#define hs_pcf hs_pcfGrid
#endif
#ifdef HS_MASK_EDGES
#include "map/edge_mask.glsl"
#else
#include "map/block_mask.glsl"
#endif

float halfshadow_class() {
  hs_prepare();
  return hs_maskClass();
}

float halfshadow_visibility() {
  hs_prepare();
#ifdef HS_PHASE_FILTER
#ifdef HS_FETCHES_ALWAYS
  float lit = hs_pcf();
  return hs_lightMisses ? 1.0 : lit;
#else
  return hs_lightMisses ? 1.0 : hs_pcf();
#endif
#else
  float known = hs_maskClass();
#ifdef HS_SKIP_LOOP
  float filtered = hs_pcfGridBounded(known < -0.5 ? float(HS_KERNEL * HS_KERNEL) : 0.0);
  return known < -0.5 ? filtered : known;
#else
  if (known > -0.5) return known;
  return hs_pcf();
#endif
#endif
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
