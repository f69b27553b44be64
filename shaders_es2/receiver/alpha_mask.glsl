// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Holes that a material's alpha cuts: nothing is drawn there, nor casts. Called last, since derivatives end behind it.
#ifdef HS_ALPHA_MASK
uniform HS_HIGHP sampler2D u_alphaMask;
uniform HS_HIGHP float u_alphaCutoff;
#ifndef HS_SHADED
varying HS_HIGHP vec2 v_texcoord;
#ifdef HS_VERTEX_COLORS
varying vec4 v_color;
#endif
#endif
void hs_cut() {
  HS_HIGHP float alpha = texture2D(u_alphaMask, v_texcoord).a;
#ifdef HS_VERTEX_COLORS
  alpha *= v_color.a;
#endif
  if (alpha < u_alphaCutoff) discard;
}
#else
#define hs_cut()
#endif
