// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One tile of the box atlas: means over boxes of one side and of twice that side about the same centre.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_smallerBoxes;
uniform HS_HIGHP sampler2D u_largerBoxes;
uniform HS_HIGHP vec4 u_widthLayout;  // xy: texels per side, zw: 1 / xy
uniform HS_HIGHP vec4 u_box;            // x: texels from a smaller box's texel to that of the larger box about its centre

void main() {
  HS_HIGHP vec2 cell = floor(v_uv * u_widthLayout.xy) + 0.5;
  gl_FragColor = vec4(texture2D(u_smallerBoxes, cell * u_widthLayout.zw).rg,
                      texture2D(u_largerBoxes, (cell + u_box.x) * u_widthLayout.zw).rg);
}
