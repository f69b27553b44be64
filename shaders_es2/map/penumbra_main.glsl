// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Entry points of filters that follow the penumbra: bounds around the fragment tell where none is needed.
// Needs horizon.glsl, penumbra_bounds.glsl, and from the includer
// hs_penumbraWidth(): sides of the penumbra in texels for hs_kernel, or -1: lit, or -2: umbra;
// hs_filter(width): the share that is lit of so much of the map around the fragment.
float halfshadow_class() {
  hs_prepare();
  float known = hs_maskClass();
  return known > -0.5 ? known * hs_lightAbove() : known;
}

float hs_filterOf(HS_HIGHP vec2 width) {
  if (width.x < 0.0) return width.x < -1.5 ? 0.0 : 1.0;
  return hs_filter(width);
}

#if defined(HS_ONE_SEARCH) && !defined(HS_SHORT)
float hs_meanVisibility() {
  hs_enterSubLight(float(HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V / 2));
  HS_HIGHP vec2 width = hs_penumbraWidth();
  return width.x < 0.0 ? hs_lightAbove() : hs_meanOverSubLights(width.x / hs_kernel.x);
}
#elif defined(HS_SUB_LIGHTS_U)
// HS_ONE_SEARCH: as in sub_light_taps.glsl, for devices that have no room for that.
float hs_correctedFilter(HS_HIGHP vec2 width) {
#ifdef HS_ONE_SEARCH
  HS_HIGHP vec2 found = hs_searchTaps(width, float(HS_SPREAD_KERNEL));
  if (found.x <= 0.0 || found.x >= 1.0) return found.x <= 0.0 ? 1.0 : 0.0;
  width = u_penumbra.xy * u_subLightShare.xy * found.y;
#endif
  return hs_filterOf(width);
}

float hs_meanVisibility() {
  HS_HIGHP float widestGap = hs_widestGap;
#ifdef HS_ONE_SEARCH
  hs_enterSubLight(float(HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V / 2));
  HS_HIGHP vec2 width = hs_penumbraWidth();
  if (width.x < 0.0) return hs_lightAbove();
  width *= u_subLightShare.xy;
#else
  HS_HIGHP vec2 width;
  hs_kernel = u_penumbra.xy * u_subLightShare.xy;
#endif
  float sum = 0.0;
  float seen = 0.0;
  float all = 0.0;
  for (int i = 0; i < HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V; ++i) {
    hs_enterSubLight(float(i));
    float above = hs_subLightAbove();
    all += above;
#ifdef HS_HORIZON
    // From below the horizon the caster's own body hides the fragment: what a part that reaches above it sees, the
    // others tell.
    if (above <= 0.0 || hs_turned * u_receiver.x < 0.0) continue;
#endif
#ifndef HS_ONE_SEARCH
    hs_widestGap = widestGap;
    width = hs_penumbraWidth();
#endif
    sum += above * hs_correctedFilter(width);
    seen += above;
  }
  return sum * (all / (max(seen, 1e-3) * float(HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V)));
}
#else
float hs_meanVisibility() { return hs_lightAbove() * hs_filterOf(hs_penumbraWidth()); }
#endif

float halfshadow_visibility() {
  hs_prepare();
  float known = hs_maskClass();
  if (known > -0.5) return known * hs_lightAbove();
  hs_kernel = u_penumbra.xy;
  return hs_meanVisibility();
}
