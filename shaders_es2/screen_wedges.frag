// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Visibility from what wedges left on the screen: sums of coverage, shares of
// quadrants that are covered, or the visibility itself.
#include "tap_count.glsl"
#include "wedge_sums.glsl"
uniform HS_HIGHP sampler2D u_wedges;
uniform HS_HIGHP vec4 u_viewport;  // xy: 1 / size, zw: -origin / size
uniform HS_HIGHP vec4 u_wedgeSteps;
float halfshadow_visibility() {
  HS_COUNT(1);
  HS_HIGHP vec4 stored = texture2D(u_wedges, gl_FragCoord.xy * u_viewport.xy + u_viewport.zw);
#ifdef HS_WEDGE_SUMS
  return 1.0 - clamp(hs_decodeCoverage(stored, u_wedgeSteps.x), 0.0, 1.0);
#elif defined(HS_WEDGE_SHARES)
  return 1.0 - dot(stored, vec4(0.25));
#else
  return stored.r;
#endif
}
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
