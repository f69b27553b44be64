// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "receiver/tap_count.glsl"
#include "map/depth_storage.glsl"
#include "receiver/receiver_inputs.glsl"
#include "map/shadow_tap.glsl"
#include "map/sub_lights.glsl"
float hs_visibility() { return hs_hardTap(); }

float halfshadow_visibility() {
  hs_prepare();
  // Fetched whether it is needed or not: inside an `if` it would cost some compilers a thread.
  float lit = hs_meanVisibility();
  return hs_lightMisses ? 1.0 : lit;
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
