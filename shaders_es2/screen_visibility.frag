// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Visibility that earlier passes left on the screen, one light a channel, or counts of what hides the light.
#include "tap_count.glsl"
uniform HS_HIGHP sampler2D u_screen;
uniform HS_HIGHP vec4 u_viewport;  // xy: 1 / size, zw: -origin / size
uniform HS_HIGHP vec4 u_channel;   // the light's channel, scaled
uniform HS_HIGHP float u_offset;
float halfshadow_visibility() {
  HS_COUNT(1);
  vec4 texel = texture2D(u_screen, gl_FragCoord.xy * u_viewport.xy + u_viewport.zw);
  return clamp(u_offset + dot(texel, u_channel), 0.0, 1.0);
}
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
