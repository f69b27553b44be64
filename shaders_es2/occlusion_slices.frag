// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Sorts a fragment into its slice.
varying HS_HIGHP vec2 v_slice;
uniform HS_HIGHP vec4 u_sliceLow;   // of the slice in each channel (HS_SLICE_DEPTH: of two slices, in xy)
uniform HS_HIGHP vec4 u_sliceHigh;

void main() {
  HS_HIGHP float s = 0.5 * (v_slice.x / v_slice.y) + 0.5;
#ifdef HS_SLICE_DEPTH
  // Occupied, and how deep inside the slice: both average correctly over any region.
  vec2 inside = step(u_sliceLow.xy, vec2(s)) * (1.0 - step(u_sliceHigh.xy, vec2(s)));
  vec2 depth = clamp((vec2(s) - u_sliceLow.xy) / (u_sliceHigh.xy - u_sliceLow.xy), 0.0, 1.0);
  gl_FragColor = vec4(inside.x, inside.x * depth.x, inside.y, inside.y * depth.y);
#else
  gl_FragColor = step(u_sliceLow, vec4(s)) * (1.0 - step(u_sliceHigh, vec4(s)));
#endif
}
