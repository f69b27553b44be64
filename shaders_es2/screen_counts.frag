// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Visibility from counts of shadowed light samples, accumulated on the screen.
#include "tap_count.glsl"
uniform HS_HIGHP sampler2D u_counts;
uniform HS_HIGHP vec4 u_screen;  // xy: 1 / size of the count image, z: 255 / samples, w: y offset of the viewport
float halfshadow_visibility() {
  HS_COUNT(1);
  vec4 counts = texture2D(u_counts, gl_FragCoord.xy * u_screen.xy);
  return 1.0 - dot(counts, vec4(u_screen.z));
}
#include "receiver_main.glsl"
