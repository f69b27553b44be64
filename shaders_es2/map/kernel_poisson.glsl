// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer filtering over a Poisson disc of HS_POISSON_COUNT taps with a radius of u_poisson.x texels.
// HS_POISSON_TAPS(TAP) expands to TAP(x, y) for each point of the unit disc.
uniform HS_HIGHP vec4 u_poisson;  // x: radius in texels

float hs_discTap(HS_HIGHP vec2 axis, HS_HIGHP vec2 point, HS_HIGHP float bias) {
  HS_HIGHP vec2 turned = vec2(axis.x * point.x - axis.y * point.y, axis.y * point.x + axis.x * point.y);
  HS_HIGHP vec2 center = floor(hs_texel + turned) + 0.5;
  return hs_lit(center, hs_receiver, dot(hs_gradient, center - hs_texel), bias);
}

float hs_pcfPoisson() {
  HS_HIGHP float bias = u_bias.x + u_bias.y * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP vec2 axis = vec2(u_poisson.x, 0.0);
#ifdef HS_ROTATE
  // Interleaved gradient noise (Jimenez 2014) turns the disc by a different angle in neighbouring pixels.
  HS_HIGHP float turn = 6.2831853 * fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
  axis = u_poisson.x * vec2(cos(turn), sin(turn));
#endif
  float lit = 0.0;
// One line: GLSL ES 1.00 has no line continuation.
#define HS_TAP(px, py) lit += hs_discTap(axis, vec2(px, py), bias);
  HS_POISSON_TAPS(HS_TAP)
  return lit * (1.0 / float(HS_POISSON_COUNT));
}
