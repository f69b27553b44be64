// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Visibility that earlier passes left on the screen, one light a channel, or high and low byte, or counts of
// what hides the light.
#include "receiver/tap_count.glsl"
uniform HS_HIGHP sampler2D u_screen;
uniform HS_HIGHP vec4 u_viewport;  // xy: 1 / size, zw: -origin / size
uniform HS_HIGHP vec4 u_channel;   // the light's channel, scaled
uniform HS_HIGHP float u_offset;
#ifdef HS_COUNT_TAPS
uniform HS_HIGHP vec4 u_earlierTaps;  // of a texel; 0: it holds visibility
#endif
varying HS_HIGHP vec4 v_map;  // w: height over the light's plane
float halfshadow_visibility() {
  HS_COUNT(1);
#ifdef HS_COUNT_TAPS
  // What earlier passes fetched for it, where they left that instead.
  HS_COUNT(floor(dot(texture2D(u_screen, gl_FragCoord.xy * u_viewport.xy + u_viewport.zw), u_earlierTaps) + 0.5));
#endif
  vec4 texel = texture2D(u_screen, gl_FragCoord.xy * u_viewport.xy + u_viewport.zw);
  // Volumes of casters that reach behind the light go on there, where it shines on nothing.
  return v_map.w <= 0.0 ? 1.0 : clamp(u_offset + dot(texel, u_channel), 0.0, 1.0);
}
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
