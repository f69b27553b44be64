// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Two slices of the texels of all views' maps, from what their centres of projection see three times as finely: share
// of the texel that is occupied, and that share times the mean depth inside the slice.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;  // packed depth
uniform HS_HIGHP vec4 u_sourceSize;   // x: texels per side, y: 1 / x, z: texels per side of the target
uniform HS_HIGHP vec4 u_sliceLow;     // as in occlusion_slices.frag
uniform HS_HIGHP vec4 u_sliceHigh;
uniform HS_HIGHP vec4 u_sliceDepth;
#ifdef HS_LAST_RECEIVERS
uniform HS_HIGHP sampler2D u_lastReceivers;
#endif

HS_HIGHP float hs_depthAt(HS_HIGHP vec4 stored) {
  return dot(floor(stored.rgb * 255.0 + 0.5), vec3(65536.0, 256.0, 1.0)) * (1.0 / 16777215.0);
}

void main() {
  HS_HIGHP vec2 first = floor(v_uv * u_sourceSize.z) * 3.0 + 0.5;
  HS_HIGHP vec2 offset = vec2(0.0);
  HS_HIGHP vec4 sum = vec4(0.0);
  for (int i = 0; i < 9; ++i) {
    HS_HIGHP vec2 place = (first + offset) * u_sourceSize.y;
    HS_HIGHP float depth = hs_depthAt(texture2D(u_source, place));
    HS_HIGHP float s = depth * u_sliceDepth.x;
#ifdef HS_LAST_RECEIVERS
    // What lies behind all receivers occupies no slice.
    s += step(hs_depthAt(texture2D(u_lastReceivers, place)) - depth, u_sliceDepth.z) * 1e4;
#endif
    HS_HIGHP vec2 inside = step(u_sliceLow.xy, vec2(s)) * (1.0 - step(u_sliceHigh.xy, vec2(s)));
    HS_HIGHP vec2 share = clamp((vec2(s) - u_sliceLow.xy) / (u_sliceHigh.xy - u_sliceLow.xy), 0.0, 1.0);
    sum += vec4(inside.x, inside.x * share.x, inside.y, inside.y * share.y);
    offset.x += 1.0;
    HS_HIGHP float wrapped = step(2.5, offset.x);
    offset += wrapped * vec2(-3.0, 1.0);
  }
  gl_FragColor = sum * (1.0 / 9.0);
}
