// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Receivers' distance along the view axis, 1 = the farthest.
attribute highp vec3 a_position;
uniform highp mat4 u_clipFromObject;
uniform highp float u_inverseFarthest;
varying highp float v_distance;
void main() {
  gl_Position = u_clipFromObject * vec4(a_position, 1.0);
  v_distance = gl_Position.w * u_inverseFarthest;
}
