// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Diffuse shading of receivers for pictures; positions are relative to the first light's centre, world axes, in units
// in which all receivers are within 1 of it: squares of lengths neither vanish nor overflow.
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

#ifdef HS_NO_HIGHP
#define HS_LEAST 1e-4
#else
#define HS_LEAST 1e-30
#endif

// v in units in which its square neither vanishes nor overflows; scale: what turns v's own lengths into those units.
HS_HIGHP vec3 hs_squarable(HS_HIGHP vec3 v, out HS_HIGHP float scale) {
#ifdef HS_NO_HIGHP
  scale = 1.0 / max(max(max(abs(v.x), abs(v.y)), abs(v.z)), 1e-4);
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
#ifdef HS_DERIVATIVES
  if (dot(n, n) < 1e-12) n = cross(dFdx(v_shadePosition), dFdy(v_shadePosition));
#ifdef HS_NO_HIGHP
  n /= max(max(max(abs(n.x), abs(n.y)), abs(n.z)), 1e-7);  // its square would vanish
#endif
#endif
  HS_HIGHP float scale = inversesqrt(max(dot(n, n), HS_LEAST));
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
float hs_sheen(HS_HIGHP vec4 n, vec3 albedo) {
  HS_HIGHP float scale;
  HS_HIGHP vec3 toEye = hs_squarable(u_eye.xyz - v_shadePosition, scale);
  float facing = dot(n.xyz, toEye) * (n.w * inversesqrt(max(dot(toEye, toEye), HS_LEAST)));
  float grazing = 1.0 - clamp(facing, 0.0, 1.0);
  float darkness = clamp(1.0 - 4.0 * max(max(albedo.r, albedo.g), albedo.b), 0.0, 1.0);
  return darkness * (0.06 + 0.6 * grazing * grazing * grazing) * hs_sky(n);
}

// light: xyz centre, w the distance at which the intensity counts 1; 0: it does so everywhere
// emission: xyz unit; its w and the colour's: slope and offset of a cone's edge over the cosine, see KHR_lights_punctual
vec3 hs_lightTerm(HS_HIGHP vec4 n, HS_HIGHP vec4 light, HS_HIGHP vec4 emission, HS_HIGHP vec4 color) {
  HS_HIGHP float scale;
  HS_HIGHP vec3 fromLight = hs_squarable(v_shadePosition - light.xyz, scale);
  HS_HIGHP float inverse = inversesqrt(max(dot(fromLight, fromLight), HS_LEAST));
  HS_HIGHP float ahead = dot(emission.xyz, fromLight) * inverse;
  float cosine = max(-dot(n.xyz, fromLight) * (inverse * n.w), 0.0) * step(0.0, ahead);
  float cone = clamp(ahead * emission.w + color.w, 0.0, 1.0);
  HS_HIGHP float nearness = inverse * (scale * light.w);
  float falloff = light.w > 0.0 ? min(nearness * nearness, 4.0) : 1.0;
  return color.rgb * (0.85 * falloff * cosine * cone * cone);
}

vec3 hs_display(vec3 linear) { return sqrt(clamp(linear, 0.0, 1.0)); }
