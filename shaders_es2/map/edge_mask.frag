// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Edges of the depth map by a Laplacian of 5 or 9 taps, in one or three strengths.
// Based on: Evans, Agenjo, Blat, "Variable Penumbra Soft Shadows for Mobile Devices", 2014, equations 1 and 2,
// section 4.4. Depth is affine in reciprocal distance, so a slanted plane has no edge and the strength is
// proportional to the penumbra's width in texels.
#include "map/depth_storage.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_depthMap;
uniform HS_HIGHP vec4 u_sourceSize;
uniform HS_HIGHP vec4 u_edge;  // x: strength per unit of depth difference, yzw: thresholds

HS_HIGHP float hs_at(HS_HIGHP float x, HS_HIGHP float y) {
  return hs_depthValue(texture2D(u_depthMap, v_uv + vec2(x, y) * u_sourceSize.y));
}

void main() {
  HS_HIGHP float center = hs_at(0.0, 0.0);
  // Differences are summed, not depths: their small values survive fp16.
  HS_HIGHP float sum = (center - hs_at(-1.0, 0.0)) + (center - hs_at(1.0, 0.0)) + (center - hs_at(0.0, -1.0)) +
                       (center - hs_at(0.0, 1.0));
#ifdef HS_LAPLACIAN9
  sum += (center - hs_at(-1.0, -1.0)) + (center - hs_at(1.0, -1.0)) + (center - hs_at(-1.0, 1.0)) +
         (center - hs_at(1.0, 1.0));
#endif
  HS_HIGHP float strength = abs(sum) * u_edge.x;
  // Blue: weak, green: medium, red: strong; alpha: any.
  float weak = step(u_edge.y, strength), medium = step(u_edge.z, strength), strong = step(u_edge.w, strength);
  gl_FragColor = vec4(strong, medium - strong, weak - medium, weak);
}
