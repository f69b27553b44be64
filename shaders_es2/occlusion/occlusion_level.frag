// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One level of an N-buffer: the mean of four kernels of the level before, half as wide, side by side. Nothing
// lies outside the map.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
uniform HS_HIGHP vec4 u_sourceSize;  // x: texels per side, y: 1 / x
uniform HS_HIGHP vec4 u_place;       // x: samples per side, y: source texels per sample, z: source index at 0, w: step

void main() {
  HS_HIGHP vec2 first = (floor(v_uv * u_place.x) * u_place.y + u_place.z + 0.5) * u_sourceSize.y;
#ifdef HS_FIRST_LEVEL
  // The map with its margin.
  HS_HIGHP vec2 inside = step(abs(first - 0.5), vec2(0.5));
  gl_FragColor = texture2D(u_source, first) * (inside.x * inside.y);
#else
  // Margins are empty as far as kernels reach, so that clamped fetches beyond them read nothing too.
  HS_HIGHP float stride = u_place.w * u_sourceSize.y;
  gl_FragColor = 0.25 * (texture2D(u_source, first) + texture2D(u_source, first + stride) +
                         texture2D(u_source, first + vec2(stride, 0.0)) + texture2D(u_source, first + vec2(0.0, stride)));
#endif
}
