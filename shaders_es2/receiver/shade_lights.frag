// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Lit colour of up to four lights whose visibilities an earlier pass left on the screen, one in each channel.
#define HS_LIGHTS_APART
#include "receiver/shade.glsl"
#include "receiver/alpha_mask.glsl"
uniform HS_HIGHP sampler2D u_visibility;
uniform HS_HIGHP vec4 u_viewport;          // xy: 1 / size, zw: -origin / size
uniform HS_HIGHP vec4 u_lightPosition[4];  // xyz: relative to the first light's centre, w: reference distance, 0: none
uniform HS_HIGHP vec4 u_lightEmission[4];  // xyz: unit direction, w: slope of the cone's edge
uniform HS_HIGHP vec4 u_lightColor[4];     // rgb: what hs_lightTerm() multiplies, 0 where there is no light; w: offset of the cone's edge

void main() {
  vec4 visibility = texture2D(u_visibility, gl_FragCoord.xy * u_viewport.xy + u_viewport.zw);
  HS_HIGHP vec4 n = hs_shadingNormal();
  vec3 sum = vec3(hs_sky(n));
  sum += hs_lightTerm(n, u_lightPosition[0], u_lightEmission[0], u_lightColor[0]) * visibility.r;
  sum += hs_lightTerm(n, u_lightPosition[1], u_lightEmission[1], u_lightColor[1]) * visibility.g;
  sum += hs_lightTerm(n, u_lightPosition[2], u_lightEmission[2], u_lightColor[2]) * visibility.b;
  sum += hs_lightTerm(n, u_lightPosition[3], u_lightEmission[3], u_lightColor[3]) * visibility.a;
  vec3 albedo = hs_albedo();
  gl_FragColor = vec4(hs_display(albedo * sum + hs_sheen(n, albedo)), 1.0);
  hs_cut();
}
