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

#ifdef HS_SUB_LIGHTS_U
// Maps of HS_SUB_LIGHTS_U x HS_SUB_LIGHTS_V sub-lights in an atlas. They share their window and the light's plane, so
// that a fragment's places in them differ by a multiple of its depth: one varying serves all.
uniform HS_HIGHP vec4 u_subLightStep;  // texels per unit of depth between neighbours, xy along u, zw along v
// x: depth at which all places agree, y: texels per unit of depth from there to the outermost map,
// z: 1 / atlas in texels, w: maps in its rows
uniform HS_HIGHP vec4 u_subLights;
uniform HS_HIGHP vec4 u_subLightShare;  // xy: sides of a sub-light as shares of the light's
#endif

// Filled by hs_prepare(), which every entry point calls first: derivatives are undefined inside branches.
bool hs_lightMisses = false;      // in front of every caster, or behind the light
HS_HIGHP vec2 hs_texel;           // map position in texels
HS_HIGHP vec2 hs_gradient;        // change of the receiver plane's depth per texel along s and t, depth units
HS_Depth hs_receiver;             // depth to compare
HS_HIGHP float hs_receiverValue;  // depth as one number, depth units: for widths, not for comparisons

#ifdef HS_SUB_LIGHTS_U
HS_HIGHP vec2 hs_tile;            // of the atlas, whose map the fragment looks at: column and row
HS_HIGHP vec2 hs_centerTexel, hs_centerGradient;
HS_HIGHP float hs_turned;         // height of the sub-light entered above the facet's horizon, where the light's centre has 1

// From now on hs_texel and hs_gradient are those of the map of one sub-light, counted along u, then along v.
void hs_enterSubLight(HS_HIGHP float index) {
  HS_HIGHP float v = floor((index + 0.5) * (1.0 / float(HS_SUB_LIGHTS_U)));
  HS_HIGHP float u = index - v * float(HS_SUB_LIGHTS_U);
  HS_HIGHP vec2 perDepth = (u - 0.5 * float(HS_SUB_LIGHTS_U - 1)) * u_subLightStep.xy +
                           (v - 0.5 * float(HS_SUB_LIGHTS_V - 1)) * u_subLightStep.zw;
  hs_texel = hs_centerTexel + perDepth * (hs_receiverValue - u_subLights.x);
  // Along the plane places move by g . dx, of which perDepth times the change of depth is the maps' difference.
  hs_turned = 1.0 + dot(hs_centerGradient, perDepth);
  HS_HIGHP float turned = abs(hs_turned) < 1e-3 ? 1e-3 : hs_turned;
  hs_gradient = clamp(hs_centerGradient / turned, -u_map.w, u_map.w);
  hs_tile.y = floor((index + 0.5) / u_subLights.w);
  hs_tile.x = index - hs_tile.y * u_subLights.w;
}

// A place in texels of the map as texture coordinates; beyond the border is the border.
HS_HIGHP vec2 hs_mapUv(HS_HIGHP vec2 texel) {
  return (hs_tile * u_map.x + clamp(texel, vec2(0.5), vec2(u_map.x - 0.5))) * u_subLights.z;
}
#else
HS_HIGHP vec2 hs_mapUv(HS_HIGHP vec2 texel) { return texel * u_map.y; }
#endif

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
#ifdef HS_SUB_LIGHTS_U
  hs_centerTexel = hs_texel;
  hs_centerGradient = hs_gradient;
#endif
}
