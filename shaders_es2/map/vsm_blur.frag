// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Mean of HS_KERNEL moments along u_direction.
#include "map/vsm_moments.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceSize;
uniform HS_HIGHP vec4 u_direction;
void main() {
  HS_HIGHP vec2 sum = vec2(0.0);
  HS_HIGHP vec2 stride = u_direction.xy * u_sourceSize.y;
  HS_HIGHP vec2 uv = v_uv - 0.5 * float(HS_KERNEL - 1) * stride;
  for (int i = 0; i < HS_KERNEL; ++i) {
    sum += hs_unpackMoments(texture2D(u_source, uv));
    uv += stride;
  }
  gl_FragColor = hs_packMoments(sum * (1.0 / float(HS_KERNEL)));
}
