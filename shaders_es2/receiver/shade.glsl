// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Diffuse shading of receivers for pictures; positions are relative to the first light's centre, world axes. Of one
// light they are in units in which all receivers are within 128 of it: squares of lengths neither vanish nor overflow,
// not even fp16. HS_LIGHTS_APART: of several, which may be far from each other, in units in which they are within 1.
// What no surface or light of the draw needs is left out: HS_DARK, HS_LIGHT_BEHIND (the surface reaches behind a
// light's plane), HS_LIGHT_CONES, HS_LIGHT_FADES.
uniform HS_HIGHP vec4 u_baseColor;
uniform HS_HIGHP vec4 u_eye;
varying HS_HIGHP vec3 v_shadePosition;
varying HS_HIGHP vec3 v_shadeNormal;
varying HS_HIGHP vec2 v_texcoord;
#ifdef HS_VERTEX_COLORS
varying vec4 v_color;
#endif
#ifdef HS_BASE_COLOR_TEXTURE
uniform HS_HIGHP sampler2D u_baseColorTexture;
#endif

#if defined(HS_DARK) || defined(HS_BASE_COLOR_TEXTURE) || defined(HS_VERTEX_COLORS)
#define HS_SHEEN
#endif

#ifdef HS_NO_HIGHP
#define HS_LEAST 1e-4
#else
#define HS_LEAST 1e-30
#endif

// v in units in which its square neither vanishes nor overflows, if it is not shorter than `least`; scale: what turns
// v's own lengths into those units.
HS_HIGHP vec3 hs_squarable(HS_HIGHP vec3 v, float least, out HS_HIGHP float scale) {
#ifdef HS_NO_HIGHP
  scale = 1.0 / max(max(max(abs(v.x), abs(v.y)), abs(v.z)), least);
  return v * scale;
#else
  scale = 1.0;
  return v;
#endif
}

// xyz: smooth where the mesh has normals, else the facet's; w: what scales it to unit length and turns it towards the
// eye.
HS_HIGHP vec4 hs_shadingNormal() {
  HS_HIGHP vec3 n = v_shadeNormal;
  HS_HIGHP float scale;
#ifdef HS_DERIVATIVES
  if (dot(n, n) < 1e-12) n = cross(dFdx(v_shadePosition), dFdy(v_shadePosition));
  n = hs_squarable(n, 1e-7, scale);
#endif
  scale = inversesqrt(max(dot(n, n), HS_LEAST));
  return vec4(n, dot(n, u_eye.xyz - v_shadePosition) < 0.0 ? -scale : scale);
}

vec3 hs_albedo() {
  vec3 albedo = u_baseColor.rgb;
#ifdef HS_VERTEX_COLORS
  albedo *= v_color.rgb;
#endif
#ifdef HS_BASE_COLOR_TEXTURE
  vec3 texel = texture2D(u_baseColorTexture, v_texcoord).rgb;
  albedo *= texel * texel;  // close to sRGB decoding, one multiplication
#endif
  return albedo;
}

// n: as of hs_shadingNormal().
float hs_sky(HS_HIGHP vec4 n) { return 0.13 + 0.07 * (n.y * n.w); }

// What dark surfaces mirror of the sky, more at their rims: without it black ones have no shape.
vec3 hs_sheen(HS_HIGHP vec4 n, vec3 albedo) {
#ifdef HS_SHEEN
  HS_HIGHP float scale;
  HS_HIGHP vec3 toEye = hs_squarable(u_eye.xyz - v_shadePosition, 1e-4, scale);
  float facing = dot(n.xyz, toEye) * (n.w * inversesqrt(max(dot(toEye, toEye), HS_LEAST)));
  float grazing = 1.0 - clamp(facing, 0.0, 1.0);
  float darkness = clamp(1.0 - 4.0 * max(max(albedo.r, albedo.g), albedo.b), 0.0, 1.0);
  return vec3(darkness * (0.06 + 0.6 * grazing * grazing * grazing) * hs_sky(n));
#else
  return vec3(0.0);
#endif
}

// light: xyz centre, w the distance at which the intensity counts 1; 0: it does so everywhere
// emission: xyz unit; its w and the colour's: slope and offset of a cone's edge over the cosine, see KHR_lights_punctual
vec3 hs_lightTerm(HS_HIGHP vec4 n, HS_HIGHP vec4 light, HS_HIGHP vec4 emission, HS_HIGHP vec4 color) {
#ifdef HS_LIGHTS_APART
  HS_HIGHP float scale;
  HS_HIGHP vec3 fromLight = hs_squarable(v_shadePosition - light.xyz, 1e-4, scale);
#else
  const float scale = 1.0;
  HS_HIGHP vec3 fromLight = v_shadePosition;
#endif
  HS_HIGHP float inverse = inversesqrt(max(dot(fromLight, fromLight), HS_LEAST));
  float seen = max(-dot(n.xyz, fromLight) * (inverse * n.w), 0.0);
#if defined(HS_LIGHT_BEHIND) || defined(HS_LIGHT_CONES)
  HS_HIGHP float ahead = dot(emission.xyz, fromLight);
  seen *= step(0.0, ahead);
#endif
#ifdef HS_LIGHT_CONES
  float cone = clamp(ahead * inverse * emission.w + color.w, 0.0, 1.0);
  seen *= cone * cone;
#endif
#ifdef HS_LIGHT_FADES
  HS_HIGHP float nearness = inverse * (scale * light.w);
#ifdef HS_LIGHTS_APART
  seen *= light.w > 0.0 ? min(nearness * nearness, 4.0) : 1.0;
#else
  seen *= min(nearness * nearness, 4.0);
#endif
#endif
  return color.rgb * seen;
}

vec3 hs_display(vec3 linear) { return sqrt(clamp(linear, 0.0, 1.0)); }
