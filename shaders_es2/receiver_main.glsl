// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#ifdef HS_SHADED
uniform HS_HIGHP vec4 u_baseColor;
uniform HS_HIGHP vec4 u_light;       // rgb: colour times intensity, a: 1 when surfaces are two-sided
uniform HS_HIGHP vec4 u_emission;    // xyz: emission direction, w: reference distance
uniform HS_HIGHP vec4 u_eye;         // relative to the light's centre, world axes
varying HS_HIGHP vec3 v_shadePosition;
varying HS_HIGHP vec3 v_shadeNormal;
varying HS_HIGHP vec2 v_texcoord;
#ifdef HS_BASE_COLOR_TEXTURE
uniform HS_HIGHP sampler2D u_baseColorTexture;
#endif

vec3 hs_shade(float visibility) {
  HS_HIGHP vec3 toLight = normalize(-v_shadePosition);
  HS_HIGHP vec3 toEye = normalize(u_eye.xyz - v_shadePosition);
  HS_HIGHP vec3 n = v_shadeNormal;
#ifdef GL_OES_standard_derivatives
  if (dot(n, n) < 0.25) n = cross(dFdx(v_shadePosition), dFdy(v_shadePosition));
#endif
  n = normalize(n + vec3(0.0, 1e-6, 0.0));
  if (dot(n, toEye) < 0.0) n = -n;
  vec3 albedo = u_baseColor.rgb;
#ifdef HS_BASE_COLOR_TEXTURE
  vec3 texel = texture2D(u_baseColorTexture, v_texcoord).rgb;
  albedo *= texel * texel;  // close to sRGB decoding, one multiplication
#endif
  float cosine = max(dot(n, toLight), 0.0) * step(0.0, dot(u_emission.xyz, v_shadePosition));
  HS_HIGHP float ratio = u_emission.w / max(length(v_shadePosition), 1e-3 * u_emission.w);
  float sky = 0.13 + 0.07 * n.y;
  vec3 linear = albedo * (sky + u_light.rgb * (0.85 * min(ratio * ratio, 4.0) * cosine * visibility));
  return sqrt(clamp(linear, 0.0, 1.0));
}
#endif

void hs_write(float visibility) {
#if defined(HS_COUNT_TAPS)
  // Taps of this fragment in two bytes.
  gl_FragColor = vec4((vec2(mod(hs_taps, 256.0), floor(hs_taps / 256.0)) + 0.25) / 255.0, 0.0, 1.0);
#elif defined(HS_COUNT_SHADOWED)
  gl_FragColor = vec4((1.0 - visibility) * (1.0 / 255.0));
#elif defined(HS_SHADED)
  gl_FragColor = vec4(hs_shade(visibility), 1.0);
#elif defined(HS_VISIBILITY_16)
  // 16 bits in two bytes, stored a quarter above the step.
  HS_HIGHP float scaled = floor(clamp(visibility, 0.0, 1.0) * 65280.0 + 0.5);
  HS_HIGHP float high = floor(scaled / 256.0);
  gl_FragColor = vec4((vec2(high, scaled - 256.0 * high) + 0.25) / 255.0, 0.0, 1.0);
#else
  gl_FragColor = vec4(visibility);
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
}
