// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What a receiver fragment knows: its map coordinates, its depth, and the plane of its facet.
varying HS_HIGHP vec4 v_map;
// x: map size in texels, y: 1 / x, z: near distance in depth units, w: largest gradient per texel
uniform HS_HIGHP vec4 u_map;
// x: bias from storage quanta, y: bias per unit of gradient when taps are at texel centres,
// z: the same when they are anywhere inside a texel, in depth units
uniform HS_HIGHP vec4 u_bias;
#ifdef HS_FACET_NORMAL
varying HS_HIGHP vec2 v_gradient;
#endif
#ifdef HS_DEPTH_PACKED16
varying HS_HIGHP vec3 v_ramp;
uniform HS_HIGHP sampler2D u_byteRamp;
#endif

// Filled by hs_prepare(), which every entry point calls first: derivatives are undefined inside branches.
bool hs_lightMisses = false;      // in front of every caster, or behind the light
HS_HIGHP vec2 hs_texel;           // map position in texels
HS_HIGHP vec2 hs_gradient;        // change of the receiver plane's depth per texel along s and t, depth units
HS_Depth hs_receiver;             // depth to compare
HS_HIGHP float hs_receiverValue;  // depth as one number, depth units: for widths, not for comparisons

void hs_prepare() {
  hs_lightMisses = v_map.z <= 0.0 || v_map.w <= 0.0;
  HS_HIGHP float inverseZ = 1.0 / (hs_lightMisses ? 1.0 : v_map.w);
  hs_texel = v_map.xy * (inverseZ * u_map.x);
#ifdef HS_LIT_OUTSIDE
  HS_HIGHP vec2 fromCenter = abs(hs_texel - 0.5 * u_map.x);
  hs_lightMisses = hs_lightMisses || max(fromCenter.x, fromCenter.y) >= 0.5 * u_map.x;
#endif
#ifdef HS_DEPTH_PACKED16
  hs_receiver = floor(texture2DProj(u_byteRamp, v_ramp).rg * 255.0 + 0.5);
  hs_receiverValue = hs_receiver.x + hs_receiver.y * (1.0 / 256.0);
#else
  hs_receiver = v_map.z * inverseZ;
  hs_receiverValue = hs_receiver;
#endif
#ifdef HS_FACET_NORMAL
  hs_gradient = v_gradient;
#else
  // The facet's plane in (s z, t z, z): 1/z = dot(n, (s, t, 1)) / k, hence the gradient of 1 - near/z.
  HS_HIGHP vec3 position = v_map.xyw;
  HS_HIGHP vec3 n = cross(dFdx(position), dFdy(position));
  HS_HIGHP float k = dot(n, position);
  k = abs(k) < 1e-20 ? 1e-20 : k;
  hs_gradient = clamp(-u_map.z * u_map.y * n.xy / k, -u_map.w, u_map.w);
#endif
}
