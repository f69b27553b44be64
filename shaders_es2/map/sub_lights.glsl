// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Mean of hs_visibility() over the sub-lights, or hs_visibility() of a light that is seen whole.
// Needs receiver_inputs.glsl.
float hs_visibility();

float hs_meanVisibility() {
#ifdef HS_SUB_LIGHTS_U
  float sum = 0.0;
  for (int i = 0; i < HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V; ++i) {
    hs_enterSubLight(float(i));
    sum += hs_visibility();
  }
  return sum * (1.0 / float(HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V));
#else
  return hs_visibility();
#endif
}
