// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One triangle over the viewport, with texture coordinates.
attribute highp vec2 a_position;
varying highp vec2 v_uv;
void main() {
  v_uv = a_position * 0.5 + 0.5;
  gl_Position = vec4(a_position, 0.0, 1.0);
}
