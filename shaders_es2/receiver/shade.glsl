// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Diffuse shading of receivers for pictures; positions are relative to the first light's centre, world axes.
uniform HS_HIGHP vec4 u_baseColor;
uniform HS_HIGHP vec4 u_eye;
varying HS_HIGHP vec3 v_shadePosition;
varying HS_HIGHP vec3 v_shadeNormal;
varying HS_HIGHP vec2 v_texcoord;
#ifdef HS_BASE_COLOR_TEXTURE
uniform HS_HIGHP sampler2D u_baseColorTexture;
#endif

// Smooth where the mesh has normals, else the facet's; turned towards the eye.
HS_HIGHP vec3 hs_shadingNormal() {
  HS_HIGHP vec3 n = v_shadeNormal;
#ifdef HS_DERIVATIVES
  if (dot(n, n) < 1e-12) n = cross(dFdx(v_shadePosition), dFdy(v_shadePosition));
#endif
  HS_HIGHP float size = max(max(abs(n.x), abs(n.y)), abs(n.z));
  n = size > 0.0 ? normalize(n / size) : vec3(0.0, 1.0, 0.0);
  return dot(n, u_eye.xyz - v_shadePosition) < 0.0 ? -n : n;
}

vec3 hs_albedo() {
#ifdef HS_BASE_COLOR_TEXTURE
  vec3 texel = texture2D(u_baseColorTexture, v_texcoord).rgb;
  return u_baseColor.rgb * texel * texel;  // close to sRGB decoding, one multiplication
#else
  return u_baseColor.rgb;
#endif
}

float hs_sky(HS_HIGHP vec3 n) { return 0.13 + 0.07 * n.y; }

// light: xyz centre, w 1 / the distance at which the intensity counts 1; 0: it does so everywhere
vec3 hs_lightTerm(HS_HIGHP vec3 n, HS_HIGHP vec4 light, HS_HIGHP vec3 emission, vec3 color) {
  HS_HIGHP vec3 fromLight = v_shadePosition - light.xyz;
  HS_HIGHP float size = max(max(abs(fromLight.x), abs(fromLight.y)), abs(fromLight.z));
  fromLight = size > 0.0 ? fromLight / size : emission;  // squares of very small worlds would vanish
  HS_HIGHP float relative = length(fromLight);
  float cosine = max(-dot(n, fromLight) / relative, 0.0) * step(0.0, dot(emission, fromLight));
  HS_HIGHP float distance = max(relative * (size * light.w), 1e-3);
  float falloff = light.w > 0.0 ? min(1.0 / (distance * distance), 4.0) : 1.0;
  return color * (0.85 * falloff * cosine);
}

vec3 hs_display(vec3 linear) { return sqrt(clamp(linear, 0.0, 1.0)); }
