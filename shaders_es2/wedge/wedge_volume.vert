// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A corner of a wedge's volume, with the eight vertices of its piece of silhouette: a, b and h in steps of the caster's
// grid, relative to a centre in units of 64 steps. All are whole numbers, so that the fragment shader can round away
// what interpolation adds to constants. The centre comes with the exponent of a step.
attribute highp vec3 a_position;
attribute highp vec4 a_extra0;
attribute highp vec4 a_extra1;
attribute highp vec4 a_extra2;
attribute highp vec4 a_extra3;
attribute highp vec4 a_extra4;
attribute highp vec4 a_normal;
attribute highp vec4 a_texcoord;
uniform highp mat4 u_clipFromLight;
varying highp vec4 v_pieceA0;
varying highp vec4 v_pieceA1;
varying highp vec4 v_pieceB0;
varying highp vec4 v_pieceB1;
varying highp vec4 v_pieceH0;
varying highp vec4 v_pieceH1;
varying highp vec4 v_pieceCenter;

void main() {
  gl_Position = u_clipFromLight * vec4(a_position, 1.0);
  v_pieceA0 = a_extra0;
  v_pieceA1 = a_extra1;
  v_pieceB0 = a_extra2;
  v_pieceB1 = a_extra3;
  v_pieceH0 = a_extra4;
  v_pieceH1 = a_normal;
  v_pieceCenter = a_texcoord;
}
