// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Which part of the map can hold blockers of this fragment: the smallest and the largest stored depth around it,
// at the reach that the answer itself asks for.
//
// A blocker at depth d touches the fragment's cone to the light only within half the penumbra's width at d. The
// nearest caster of all bounds that width; the nearest one within it gives a smaller bound, and so on: a caster
// beside the light widens the search only where it can be in the way.
uniform HS_HIGHP sampler2D u_blockMap;
// x: blocks per side of the finest level, y: 1 / (texels per block × x), z: last level, w: slack of the reach in texels
uniform HS_HIGHP vec4 u_bounds;
// xy: kernel width in texels per unit of depth difference, z: depth of the nearest caster,
// w: 1 / reach of the finest level in texels
uniform HS_HIGHP vec4 u_penumbra;

// Depth between the fragment and the nearest caster that can block it, depth units; set by hs_maskClass().
HS_HIGHP float hs_widestGap = 0.0;
// Sides, in texels per unit of depth, of what is filtered: the light's or a sub-light's.
HS_HIGHP vec2 hs_kernel;

// The level whose answer holds all texels within `reach`, and some more: each block's and those of four to each side.
HS_HIGHP float hs_boundsLevel(HS_HIGHP float reach) {
  return clamp(ceil(log2(max(reach * u_penumbra.w, 1.0))), 0.0, u_bounds.z);
}

HS_HIGHP vec4 hs_boundsAround(HS_HIGHP float level) {
  HS_HIGHP float side = floor(u_bounds.x * exp2(-level) + 0.5);
  HS_HIGHP vec2 block = clamp(floor(hs_texel * (side * u_bounds.y)), 0.0, side - 1.0);
  HS_HIGHP vec2 origin = level < 0.5 ? vec2(0.0) : vec2(u_bounds.x, u_bounds.x - 2.0 * side);
  HS_COUNT(1);
  return floor(texture2D(u_blockMap, (origin + block + 0.5) * (vec2(2.0 / 3.0, 1.0) / u_bounds.x)) * 255.0 + 0.5);
}

// Gaps to the smallest and to the largest depth.
HS_HIGHP vec2 hs_gapsAround(HS_HIGHP float level) {
  HS_HIGHP vec4 bytes = hs_boundsAround(level);
#ifdef HS_DEPTH_PACKED16
  vec4 difference = bytes - vec4(hs_receiver, hs_receiver);
  return vec2(difference.x + difference.y * (1.0 / 256.0), difference.z + difference.w * (1.0 / 256.0));
#else
  // The upper bound is stored as the next step above, so that 65536 steps stay 16 bits.
  return vec2((bytes.r * 256.0 + bytes.g) * (1.0 / 65536.0) - hs_receiver,
              (bytes.b * 256.0 + bytes.a + 1.0) * (1.0 / 65536.0) - hs_receiver);
#endif
}

// 1: every tap is lit, 0: every tap is shadowed, -1: the filter decides. Both bounds are rounded outward.
// Of a split light the bounds hold all maps around one place: the kernel is a sub-light's, and wider by what the
// fragment's places in the maps are apart.
float hs_maskClass() {
  if (hs_lightMisses) return 1.0;
  HS_HIGHP float slope = abs(hs_gradient.x) + abs(hs_gradient.y);
  HS_HIGHP float bias = u_bias.x + u_bias.y * slope;
#ifdef HS_SUB_LIGHTS_U
  HS_HIGHP vec2 kernel = u_penumbra.xy * u_subLightShare.xy;
  HS_HIGHP float apart = abs(hs_receiverValue - u_subLights.x) * u_subLights.y + u_bounds.w;
#else
  HS_HIGHP vec2 kernel = u_penumbra.xy;
  HS_HIGHP float apart = u_bounds.w;
#endif
  HS_HIGHP float halfWidth = 0.5 * max(kernel.x, kernel.y);
  hs_widestGap = hs_receiverValue - u_penumbra.z;
  // Blocks at the border answer for what lies beyond it, where no caster is.
  HS_HIGHP vec2 fromMiddle = abs(hs_texel - 0.5 * u_map.x);
  HS_HIGHP float outside = max(fromMiddle.x, fromMiddle.y) - 0.5 * u_map.x;
#ifdef HS_SHORT
  // The first look alone, and no loop around it: what a loop keeps would take registers.
  HS_HIGHP float reach = halfWidth * hs_widestGap + apart;
  HS_HIGHP vec2 gaps = hs_gapsAround(hs_boundsLevel(reach));
  if (gaps.x >= -bias || outside >= reach) return 1.0;
  hs_widestGap = min(hs_widestGap, -gaps.x);
#else
  HS_HIGHP vec2 gaps = vec2(0.0);
  HS_HIGHP float reach = 0.0;
  HS_HIGHP float asked = -1.0;
  for (int i = 0; i < 2; ++i) {
    reach = halfWidth * hs_widestGap + apart;
    HS_HIGHP float level = hs_boundsLevel(reach);
    if (level == asked) break;
    asked = level;
    gaps = hs_gapsAround(level);
    if (gaps.x >= -bias || outside >= reach) return 1.0;
    hs_widestGap = min(hs_widestGap, -gaps.x);
  }
#endif
  return gaps.y < -bias - slope * reach ? 0.0 : -1.0;
}
