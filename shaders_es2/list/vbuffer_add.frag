// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What a batch of casters adds to a target, all of it whole steps.
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_source;
void main() { gl_FragColor = (floor(texture2D(u_source, v_uv) * 255.0 + 0.5) + 0.125) / 255.0; }
