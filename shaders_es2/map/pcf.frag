// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "receiver/tap_count.glsl"
#include "map/depth_storage.glsl"
#include "receiver/receiver_inputs.glsl"
#include "map/shadow_tap.glsl"
#include "map/sub_lights.glsl"
#ifdef HS_POISSON_COUNT
#include "map/kernel_poisson.glsl"
#define hs_pcf hs_pcfPoisson
#else
#include "map/kernel_grid.glsl"
#define hs_pcf hs_pcfGrid
#endif
float hs_visibility() { return hs_pcf(); }

float halfshadow_visibility() {
  hs_prepare();
#ifdef HS_FETCHES_ALWAYS
  float lit = hs_meanVisibility();
  return hs_lightMisses ? 1.0 : lit;
#else
  return hs_lightMisses ? 1.0 : hs_meanVisibility();
#endif
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
