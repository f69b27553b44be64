// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What alpha_mask.glsl looks up, and what shading reads beside it.
#if defined(HS_ALPHA_MASK) || defined(HS_SHADED)
attribute highp vec2 a_texcoord;
varying highp vec2 v_texcoord;
#ifdef HS_VERTEX_COLORS
attribute mediump vec4 a_extra0;  // the vertex's colour
varying mediump vec4 v_color;
#endif
void hs_passSurface() {
  v_texcoord = a_texcoord;
#ifdef HS_VERTEX_COLORS
  v_color = a_extra0;
#endif
}
#else
#define hs_passSurface()
#endif
