// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Kernels of three sizes, chosen by the channel of the dilated edge mask; hard where there is no edge.
// Based on: Evans, Agenjo, Blat 2014, section 4.4.
#include "receiver/tap_count.glsl"
#include "map/depth_storage.glsl"
#include "receiver/receiver_inputs.glsl"
#include "map/shadow_tap.glsl"
#include "map/edge_mask.glsl"
uniform HS_HIGHP vec4 u_kernels;  // sides of the three kernels, weak to strong

float halfshadow_visibility() {
  hs_prepare();
  if (hs_lightMisses) return 1.0;
  vec4 edges = hs_edges();
  HS_HIGHP float side = edges.r > 0.0 ? u_kernels.z : (edges.g > 0.0 ? u_kernels.y : (edges.b > 0.0 ? u_kernels.x : 1.0));
  HS_HIGHP float bias = u_bias.x + u_bias.y * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP vec2 first = floor(hs_texel - 0.5 * side + 0.5) + 0.5;
  HS_HIGHP float planeFirst = dot(hs_gradient, first - hs_texel);
  HS_HIGHP float count = side * side - 0.5;
  HS_HIGHP vec2 offset = vec2(0.0);
  float lit = 0.0;
  for (int i = 0; i < HS_SPREAD_KERNEL * HS_SPREAD_KERNEL; ++i) {
    if (float(i) > count) break;
    lit += hs_lit(first + offset, hs_receiver, planeFirst + dot(hs_gradient, offset), bias);
    offset.x += 1.0;
    float wrapped = step(side - 0.5, offset.x);
    offset += wrapped * vec2(-side, 1.0);
  }
  return lit / (count + 0.5);
}
#ifndef HS_FORWARD
#ifdef HS_SHADED
#include "receiver/shade.glsl"
#endif
#include "receiver/alpha_mask.glsl"
#include "receiver/receiver_main.glsl"
#endif
