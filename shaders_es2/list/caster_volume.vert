// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A corner of the volume that one caster shadows, with what is the same all over it.
attribute highp vec3 a_position;  // (a, b, h)
attribute highp vec3 a_extra0;
attribute highp vec4 a_extra1;
attribute highp vec2 a_extra2;
uniform highp mat4 u_clipFromLight;
varying highp vec3 v_casterList;
varying highp vec4 v_casterSides;
varying highp vec2 v_casterStage;
void main() {
  gl_Position = u_clipFromLight * vec4(a_position, 1.0);
  v_casterList = a_extra0;
  v_casterSides = a_extra1;
  v_casterStage = a_extra2;
}
