// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Copies one mip level into the atlas: drawn into a viewport of exactly that level's size, so the implicit
// level of detail selects it (fragment shaders of ES 2.0 cannot name a level).
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
void main() { gl_FragColor = texture2D(u_source, v_uv); }
