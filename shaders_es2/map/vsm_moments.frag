// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Distance and squared distance of the map's texels, in two bytes of 8 bits or two pairs of 16.
// Based on: Donnelly, Lauritzen, "Variance Shadow Maps", 2006.
#include "map/depth_storage.glsl"
#include "map/vsm_moments.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_depthMap;
uniform HS_HIGHP vec4 u_sourceSize;
void main() {
  HS_HIGHP float moment = hs_momentOf(hs_momentDistance(hs_depthValue(texture2D(u_depthMap, v_uv))));
  gl_FragColor = hs_packMoments(vec2(moment, moment * moment));
}
