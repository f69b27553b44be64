// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#ifdef HS_SHADED
uniform HS_HIGHP vec4 u_lightPosition[4];
uniform HS_HIGHP vec4 u_lightEmission[4];
uniform HS_HIGHP vec4 u_lightColor[4];
#endif

void hs_write(float visibility) {
#if defined(HS_COUNT_TAPS)
  // Taps of this fragment in two bytes.
  gl_FragColor = vec4((vec2(mod(hs_taps, 256.0), floor(hs_taps / 256.0)) + 0.25) / 255.0, 0.0, 1.0);
#elif defined(HS_COUNT_SHADOWED)
  gl_FragColor = vec4((1.0 - visibility) * (1.0 / 255.0));
#elif defined(HS_SHADED)
  HS_HIGHP vec4 n = hs_shadingNormal();
  vec3 light = hs_lightTerm(n, u_lightPosition[0], u_lightEmission[0], u_lightColor[0]);
  vec3 albedo = hs_albedo();
  gl_FragColor = vec4(hs_display(albedo * (hs_sky(n) + light * visibility) + hs_sheen(n, albedo)), 1.0);
#elif defined(HS_VISIBILITY_16)
  // 16 bits in two bytes, stored a quarter above the step.
  HS_HIGHP float scaled = floor(clamp(visibility, 0.0, 1.0) * 65280.0 + 0.5);
  HS_HIGHP float high = floor(scaled / 256.0);
  gl_FragColor = vec4((vec2(high, scaled - 256.0 * high) + 0.25) / 255.0, 0.0, 1.0);
#elif defined(HS_PHASE_CLASSIFY) && defined(HS_BINARY_CLASS)
  gl_FragColor = vec4(visibility + 0.25 / 255.0);
#else
  // Rounded here: gl_FragColor is mediump, and whether a compiler rounds a value to fp16 on its way to the target
  // differs from program to program. A quarter above the step, as on truncating targets.
  HS_HIGHP float rounded = floor(visibility * 255.0 + 0.5);
  gl_FragColor = vec4((rounded + 0.25) / 255.0);
#endif
}

void main() {
#if defined(HS_PHASE_CLASSIFY)
  float visibility = halfshadow_class();
  if (visibility < -0.5) discard;
  hs_write(visibility);
#else
  hs_write(halfshadow_visibility());
#endif
  hs_cut();
}
