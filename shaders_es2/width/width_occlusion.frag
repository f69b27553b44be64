// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Inverted occlusion map: 1 where a caster is, 0 where the light passes.
#include "map/depth_storage.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_depthMap;
uniform HS_HIGHP vec4 u_casterRange;  // z: depth between that of casters and that of empty texels
void main() {
  HS_HIGHP float depth = hs_depthValue(texture2D(u_depthMap, v_uv));
#ifdef HS_FARTHEST
  gl_FragColor = vec4(step(u_casterRange.z, depth));
#else
  gl_FragColor = vec4(step(depth, u_casterRange.z));
#endif
}
