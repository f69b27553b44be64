// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Entry points of filters that follow the penumbra: bounds around the fragment know where none is needed.
// Needs sub_lights.glsl, horizon.glsl, penumbra_bounds.glsl, and hs_filteredVisibility() from the includer.
float hs_visibility() {
#ifdef HS_SUB_LIGHTS_U
  float above = hs_subLightAbove();
  if (above <= 0.0) return 0.0;
  float known = hs_classWithin(true, 0.0);
  return above * (known > -0.5 ? known : hs_filteredVisibility());
#else
  return hs_lightAbove() * hs_filteredVisibility();
#endif
}

float halfshadow_class() {
  hs_prepare();
  float known = hs_maskClass();
  return known > -0.5 ? known * hs_lightAbove() : known;
}

float halfshadow_visibility() {
  hs_prepare();
  float known = hs_maskClass();
  return known > -0.5 ? known * hs_lightAbove() : hs_meanVisibility();
}
