// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Percentage closer filtering over a Poisson disc of HS_POISSON_COUNT taps with a radius of u_poisson.x texels.
// HS_POISSON_TAPS(TAP) expands to TAP(x, y) for each point of the unit disc.
uniform HS_HIGHP vec4 u_poisson;  // x: radius in texels

float hs_pcfPoisson() {
  HS_HIGHP float bias = u_bias.x + u_bias.y * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP vec2 axis = vec2(u_poisson.x, 0.0);
#ifdef HS_ROTATE
  // Interleaved gradient noise (Jimenez 2014) turns the disc by a different angle in neighbouring pixels.
  HS_HIGHP float turn = 6.2831853 * fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
  axis = u_poisson.x * vec2(cos(turn), sin(turn));
#endif
  float lit = 0.0;
#define HS_TAP(px, py)                                                                                 \
  {                                                                                                    \
    HS_HIGHP vec2 center = floor(hs_texel + vec2(axis.x * (px) - axis.y * (py), axis.y * (px) + axis.x * (py))) + 0.5; \
    lit += hs_lit(center * u_map.y, hs_receiver, dot(hs_gradient, center - hs_texel), bias);                    \
  }
  HS_POISSON_TAPS(HS_TAP)
  return lit * (1.0 / float(HS_POISSON_COUNT));
}
