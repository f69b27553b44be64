// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One level of the edge mask's mip chain with every value above zero raised to one: drawn into a target of that
// level's size, so the implicit level of detail selects it.
// Based on: Evans et al. 2014, section 4.3, after Sander et al. 2005.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
void main() { gl_FragColor = step(0.5 / 255.0, texture2D(u_source, v_uv)); }
