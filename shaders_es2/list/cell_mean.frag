// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The mean of eight targets of light cells: as many textures as the engine reads at once.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_cells0;
uniform HS_HIGHP sampler2D u_cells1;
uniform HS_HIGHP sampler2D u_cells2;
uniform HS_HIGHP sampler2D u_cells3;
uniform HS_HIGHP sampler2D u_cells4;
uniform HS_HIGHP sampler2D u_cells5;
uniform HS_HIGHP sampler2D u_cells6;
uniform HS_HIGHP sampler2D u_cells7;
void main() {
  HS_HIGHP vec4 sum = texture2D(u_cells0, v_uv) + texture2D(u_cells1, v_uv) + texture2D(u_cells2, v_uv) +
                      texture2D(u_cells3, v_uv) + texture2D(u_cells4, v_uv) + texture2D(u_cells5, v_uv) +
                      texture2D(u_cells6, v_uv) + texture2D(u_cells7, v_uv);
  HS_HIGHP float mean = dot(sum, vec4(1.0 / 32.0));
  gl_FragColor = vec4((floor(mean * 255.0 + 0.5) + 0.125) / 255.0);
}
