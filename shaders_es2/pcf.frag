// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "tap_count.glsl"
#include "depth_storage.glsl"
#include "receiver_inputs.glsl"
#include "shadow_tap.glsl"
#ifdef HS_POISSON_COUNT
#include "kernel_poisson.glsl"
#define hs_pcf hs_pcfPoisson
#else
#include "kernel_grid.glsl"
#define hs_pcf hs_pcfGrid
#endif
float halfshadow_visibility() {
  hs_prepare();
  return hs_lightMisses ? 1.0 : hs_pcf();
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
#endif
