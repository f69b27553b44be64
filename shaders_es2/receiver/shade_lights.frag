// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Lit colour of up to four lights whose visibilities an earlier pass left on the screen, one in each channel.
#include "receiver/shade.glsl"
#include "receiver/alpha_mask.glsl"
uniform HS_HIGHP sampler2D u_visibility;
uniform HS_HIGHP vec4 u_viewport;          // xy: 1 / size, zw: -origin / size
<<<<<<< HEAD
uniform HS_HIGHP vec4 u_lightPosition[4];  // xyz: relative to the first light's centre, w: reference distance, 0: none
uniform HS_HIGHP vec4 u_lightEmission[4];  // xyz: unit direction, w: 1 where distance does not count
uniform HS_HIGHP vec4 u_lightColor[4];     // rgb: colour times intensity, 0 where there is no light
=======
uniform HS_HIGHP vec4 u_lightPosition[4];  // xyz: relative to the first light's centre, w: 1 / reference distance
uniform HS_HIGHP vec4 u_lightEmission[4];  // xyz: unit direction, w: slope of the cone's edge
uniform HS_HIGHP vec4 u_lightColor[4];     // rgb: colour times intensity, 0 where there is no light; w: offset of the cone's edge
>>>>>>> 9897327 (scenes: read what glTF files use)

vec3 hs_lightAt(HS_HIGHP vec4 n, HS_HIGHP vec4 position, HS_HIGHP vec4 emission, HS_HIGHP vec4 color) {
  return hs_lightTerm(n, v_shadePosition - position.xyz, position.w, emission, color.rgb);
}

void main() {
  vec4 visibility = texture2D(u_visibility, gl_FragCoord.xy * u_viewport.xy + u_viewport.zw);
  HS_HIGHP vec4 n = hs_shadingNormal();
  vec3 sum = vec3(hs_sky(n));
<<<<<<< HEAD
  sum += hs_lightAt(n, u_lightPosition[0], u_lightEmission[0], u_lightColor[0]) * visibility.r;
  sum += hs_lightAt(n, u_lightPosition[1], u_lightEmission[1], u_lightColor[1]) * visibility.g;
  sum += hs_lightAt(n, u_lightPosition[2], u_lightEmission[2], u_lightColor[2]) * visibility.b;
  sum += hs_lightAt(n, u_lightPosition[3], u_lightEmission[3], u_lightColor[3]) * visibility.a;
=======
  sum += hs_lightTerm(n, u_lightPosition[0], u_lightEmission[0], u_lightColor[0]) * visibility.r;
  sum += hs_lightTerm(n, u_lightPosition[1], u_lightEmission[1], u_lightColor[1]) * visibility.g;
  sum += hs_lightTerm(n, u_lightPosition[2], u_lightEmission[2], u_lightColor[2]) * visibility.b;
  sum += hs_lightTerm(n, u_lightPosition[3], u_lightEmission[3], u_lightColor[3]) * visibility.a;
<<<<<<< HEAD
>>>>>>> 9897327 (scenes: read what glTF files use)
  gl_FragColor = vec4(hs_display(hs_albedo() * sum), 1.0);
=======
  vec3 albedo = hs_albedo();
  gl_FragColor = vec4(hs_display(albedo * sum + hs_sheen(n, albedo)), 1.0);
>>>>>>> 29bc789 (scenes: compose the picture from what is there)
  hs_cut();
}
