// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Lit colour of up to four lights whose visibilities an earlier pass left on the screen, one in each channel.
#include "receiver/shade.glsl"
uniform HS_HIGHP sampler2D u_visibility;
uniform HS_HIGHP vec4 u_viewport;          // xy: 1 / size, zw: -origin / size
uniform HS_HIGHP vec4 u_lightPosition[4];  // xyz: relative to the first light's centre, w: reference distance, 0: none
uniform HS_HIGHP vec4 u_lightEmission[4];  // xyz: unit direction, w: 1 where distance does not count
uniform HS_HIGHP vec4 u_lightColor[4];     // rgb: colour times intensity, 0 where there is no light

void main() {
  vec4 visibility = texture2D(u_visibility, gl_FragCoord.xy * u_viewport.xy + u_viewport.zw);
  HS_HIGHP vec4 n = hs_shadingNormal();
  vec3 sum = vec3(hs_sky(n));
  sum += hs_lightTerm(n, v_shadePosition - u_lightPosition[0].xyz, u_lightPosition[0].w, u_lightEmission[0], u_lightColor[0].rgb) * visibility.r;
  sum += hs_lightTerm(n, v_shadePosition - u_lightPosition[1].xyz, u_lightPosition[1].w, u_lightEmission[1], u_lightColor[1].rgb) * visibility.g;
  sum += hs_lightTerm(n, v_shadePosition - u_lightPosition[2].xyz, u_lightPosition[2].w, u_lightEmission[2], u_lightColor[2].rgb) * visibility.b;
  sum += hs_lightTerm(n, v_shadePosition - u_lightPosition[3].xyz, u_lightPosition[3].w, u_lightEmission[3], u_lightColor[3].rgb) * visibility.a;
  gl_FragColor = vec4(hs_display(hs_albedo() * sum), 1.0);
}
