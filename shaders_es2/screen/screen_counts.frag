// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Visibility from counts of shadowed light samples, accumulated on the screen.
#include "receiver/tap_count.glsl"
uniform HS_HIGHP sampler2D u_counts;
uniform HS_HIGHP vec4 u_viewport;  // xy: 1 / size, zw: -origin / size
uniform HS_HIGHP vec4 u_samples;   // x: 255 / samples
float halfshadow_visibility() {
  HS_COUNT(1);
  vec4 counts = texture2D(u_counts, gl_FragCoord.xy * u_viewport.xy + u_viewport.zw);
  return 1.0 - dot(counts, vec4(u_samples.x));
}
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
