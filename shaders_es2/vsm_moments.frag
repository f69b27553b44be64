// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Depth and squared depth of the map's texels, in two bytes of 8 bits or two pairs of 16.
// Based on: Donnelly, Lauritzen, "Variance Shadow Maps", 2006.
#include "depth_storage.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_depthMap;
uniform HS_HIGHP vec4 u_sourceSize;
uniform HS_HIGHP vec4 u_momentRange;  // x: depth at 0, y: 1 / (depth at 1 - depth at 0)
void main() {
  HS_HIGHP float depth = clamp((hs_depthValue(texture2D(u_depthMap, v_uv)) - u_momentRange.x) * u_momentRange.y, 0.0, 1.0);
#ifdef HS_MOMENTS_8
  gl_FragColor = vec4(depth, depth * depth, 0.0, 1.0);
#else
  HS_HIGHP vec2 scaled = floor(vec2(depth, depth * depth) * 65535.0 + 0.5);
  HS_HIGHP vec2 high = floor(scaled / 256.0);
  HS_HIGHP vec2 low = scaled - 256.0 * high;
  gl_FragColor = (vec4(high.x, low.x, high.y, low.y) + 0.25) / 255.0;
#endif
}
