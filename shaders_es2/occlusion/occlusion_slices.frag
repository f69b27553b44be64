// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Sorts a fragment into its slice.
#include "receiver/alpha_mask.glsl"
varying HS_HIGHP vec2 v_slice;
uniform HS_HIGHP vec4 u_sliceLow;   // of the slice in each channel (HS_SLICE_DEPTH: of two slices, in xy)
uniform HS_HIGHP vec4 u_sliceHigh;
uniform HS_HIGHP vec4 u_sliceDepth;  // x: slice units of depth 1; y: 1 / texels per side, z: least depth to what is shadowed
#ifdef HS_LAST_RECEIVERS
uniform HS_HIGHP sampler2D u_lastReceivers;
#endif

void main() {
  HS_HIGHP float depth = 0.5 * (v_slice.x / v_slice.y) + 0.5;
#ifdef HS_PACK_DEPTH
  // Of receivers: 24 bits, stored a quarter above the step.
  HS_HIGHP float scaled = floor(clamp(depth, 0.0, 1.0) * 16777215.0);
  HS_HIGHP float high = floor(scaled / 65536.0);
  HS_HIGHP float middle = floor((scaled - high * 65536.0) / 256.0);
  gl_FragColor = vec4((vec3(high, middle, scaled - high * 65536.0 - middle * 256.0) + 0.25) / 255.0, 1.0);
#else
  HS_HIGHP float s = depth * u_sliceDepth.x;
#ifdef HS_LAST_RECEIVERS
  // What lies behind all receivers occupies no slice.
  HS_HIGHP vec3 last = floor(texture2D(u_lastReceivers, gl_FragCoord.xy * u_sliceDepth.y).rgb * 255.0 + 0.5);
  HS_HIGHP float lastDepth = dot(last, vec3(65536.0, 256.0, 1.0)) * (1.0 / 16777215.0);
  s += step(lastDepth - depth, u_sliceDepth.z) * 1e4;
#endif
#ifdef HS_SLICE_DEPTH
  // Occupied, and how deep inside the slice: both average correctly over any region.
  vec2 inside = step(u_sliceLow.xy, vec2(s)) * (1.0 - step(u_sliceHigh.xy, vec2(s)));
  vec2 share = clamp((vec2(s) - u_sliceLow.xy) / (u_sliceHigh.xy - u_sliceLow.xy), 0.0, 1.0);
  gl_FragColor = vec4(inside.x, inside.x * share.x, inside.y, inside.y * share.y);
#else
  gl_FragColor = step(u_sliceLow, vec4(s)) * (1.0 - step(u_sliceHigh, vec4(s)));
#endif
#endif
  hs_cut();
}
