// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Upper bound of the lit share from mean and variance of depth.
// Based on: Donnelly, Lauritzen, "Variance Shadow Maps", 2006, section 3 (Chebyshev's inequality).
#include "receiver/tap_count.glsl"
#include "map/depth_storage.glsl"
#include "receiver/receiver_inputs.glsl"
#include "map/vsm_moments.glsl"
uniform HS_HIGHP sampler2D u_moments;

HS_HIGHP vec2 hs_momentsAt(HS_HIGHP vec2 texel) {
  HS_COUNT(1);
  return hs_unpackMoments(texture2D(u_moments, texel * u_map.y));
}

float halfshadow_visibility() {
  hs_prepare();
  // Four fetches are not worth a fragment that needs none.
#ifndef HS_MOMENTS_8
  if (hs_lightMisses) return 1.0;
#endif
#ifdef HS_MOMENTS_8
  HS_HIGHP vec2 moments = hs_momentsAt(hs_texel);
#else
  // Packed moments cannot be filtered by the sampler: four fetches and two mixes.
  HS_HIGHP vec2 corner = floor(hs_texel - 0.5) + 0.5;
  HS_HIGHP vec2 weight = hs_texel - corner;
  HS_HIGHP vec2 moments = mix(mix(hs_momentsAt(corner), hs_momentsAt(corner + vec2(1.0, 0.0)), weight.x),
                              mix(hs_momentsAt(corner + vec2(0.0, 1.0)), hs_momentsAt(corner + vec2(1.0)), weight.x), weight.y);
#endif
  HS_HIGHP float distance = hs_momentDistance(hs_receiverValue);
  // One texel changes the distance by the square of the whole distance times the change of depth.
  HS_HIGHP float slope = (abs(hs_gradient.x) + abs(hs_gradient.y)) * (1.0 + distance) * (1.0 + distance);
  HS_HIGHP float beyond = hs_momentOf(distance) - moments.x - u_momentRange.w - u_bias.z * slope * u_momentRange.y;
  HS_HIGHP float variance = max(moments.y - moments.x * moments.x, u_momentRange.z);
  HS_HIGHP float bound = variance / (variance + beyond * beyond);
  return hs_lightMisses || beyond <= 0.0 ? 1.0 : bound;
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
