// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer soft shadows: a blocker search over the region that could hold blockers, the penumbra's
// width from similar triangles in reciprocal depth, a filter of that width.
// Based on: Fernando, "Percentage-Closer Soft Shadows", 2005.
#include "tap_count.glsl"
#include "depth_storage.glsl"
#include "receiver_inputs.glsl"
#include "shadow_tap.glsl"
#include "kernel_spread.glsl"
#include "block_mask.glsl"
// xy: kernel width in texels per unit of depth difference, z: depth of the nearest caster
uniform HS_HIGHP vec4 u_penumbra;

float halfshadow_class() {
  hs_prepare();
  return hs_maskClass();
}

float halfshadow_visibility() {
  hs_prepare();
#ifndef HS_PHASE_FILTER
  float known = hs_maskClass();
  if (known > -0.5) return known;
#endif
  HS_HIGHP vec2 width = u_penumbra.xy * (hs_receiverValue - u_penumbra.z);
  if (hs_lightMisses || width.x <= 0.0) return 1.0;
  HS_HIGHP float bias = u_bias.x + u_bias.z * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP vec2 stride = max(width, vec2(1.0)) * (1.0 / float(HS_SEARCH));
  HS_HIGHP vec2 first = -0.5 * float(HS_SEARCH - 1) * stride;
  HS_HIGHP vec2 offset = first;
  float column = 0.0;
  float blockers = 0.0;
  HS_HIGHP float gapSum = 0.0;
  for (int i = 0; i < HS_SEARCH * HS_SEARCH; ++i) {
    HS_HIGHP float gap = hs_gap(texture2D(u_depthMap, (hs_texel + offset) * u_map.y), hs_receiver);
    HS_COUNT(1);
    HS_HIGHP float blocks = 1.0 - step(min(dot(hs_gradient, offset), 0.0) - bias, gap);
    blockers += blocks;
    gapSum += blocks * gap;
    column += 1.0;
    float wrapped = step(float(HS_SEARCH) - 0.5, column);
    column -= wrapped * float(HS_SEARCH);
    offset.x = first.x + column * stride.x;
    offset.y += wrapped * stride.y;
  }
  if (blockers < 0.5) return 1.0;
  if (blockers > float(HS_SEARCH * HS_SEARCH) - 0.5) return 0.0;
  HS_HIGHP vec2 kernel = max(u_penumbra.xy * (-gapSum / blockers), vec2(1.0));
  return hs_pcfSpread(kernel);
}
#ifdef HS_SHADED
#include "shade.glsl"
#endif
#include "receiver_main.glsl"
