// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Mean visibility over sub-lights: one fetch each, and as little else as can be, since it runs for each of them.
// HS_MAY_CAST: the receiver may be in the map itself; a second fetch then where it is.
// Needs horizon.glsl, edge_profile.glsl, part_order.glsl, and the uniforms of shadow_width.frag.

// The narrowest kernel, in texels of the width map. Distances are right to a part of a texel, so that receivers
// which are smooth need no more; on a caster's own surface the nearest silhouette is as wrong as the map is coarse.
#ifdef HS_MAY_CAST
#define HS_NARROWEST 1.0
#else
#define HS_NARROWEST 0.5
#endif

// Lit share, of what the map stores where the fragment is. width: the kernel's side in texels; corners: weight of what the
// edge's profile misses.
float hs_litByEdge(HS_HIGHP vec4 stored, HS_HIGHP float width, HS_HIGHP float corners, HS_HIGHP float leastInside) {
  HS_HIGHP float share = max(stored.r * (255.0 / 127.0) - 1.0, leastInside);
  HS_HIGHP float size = abs(share);
  HS_HIGHP float knee = u_widthRange.y / u_widthRange.x + 1.0;
  HS_HIGHP float kernel = max(width, HS_NARROWEST * u_casterDepth.z);
  HS_HIGHP float part = hs_smallerPart(size * u_widthRange.y / ((knee - size) * kernel));
  HS_HIGHP float missed = corners * (stored.g * (255.0 / 127.0) - 1.0);
  return clamp((share < 0.0 ? 1.0 - part : part) - missed, 0.0, 1.0);
}

// The map holds what the profile misses of kernels of the farthest receiver; narrower ones miss less.
HS_HIGHP float hs_cornerWeight(HS_HIGHP vec2 widths) { return clamp(widths.x / max(widths.y, 0.01), 0.0, u_kernel.w); }

// Of the nearest caster, for this fragment and for the farthest receiver.
HS_HIGHP vec2 hs_widestKernels() {
  return vec2(u_kernel.x * (hs_receiverValue - u_casterDepth.x), u_kernel.z);
}

// Of the sub-lights there are fewer; compilers unroll loops of up to 32 turns.
#define HS_MORE_THAN_UNROLLED 48

#ifdef HS_MAY_CAST
// Of the sub-light that was entered.
float hs_litByWidths() {
  HS_HIGHP vec2 size = u_widthTile.xy;
  HS_HIGHP vec2 texel = clamp(hs_texel * u_widthPlace.xy + u_widthPlace.z, vec2(0.5), size - 0.5);
  HS_HIGHP vec4 stored = texture2D(u_widthMap, (hs_tile * size + texel) * u_widthLayout.zw);
  HS_COUNT(1);
  HS_HIGHP vec2 widths = hs_widestKernels() - u_kernel.y * stored.b;
  HS_HIGHP float corners = hs_cornerWeight(widths);
  HS_HIGHP float slope = abs(hs_gradient.x) + abs(hs_gradient.y);
  HS_HIGHP float leastInside = -1.0;
  if (hs_receiverValue - u_bias.x - u_bias.z * slope <= hs_casterDepth(stored.a + 1.0 / 255.0)) {
    // Only the exact depth knows, and what it finds lit is.
    HS_HIGHP vec2 center = floor(hs_texel) + 0.5;
    HS_HIGHP float gap = hs_gap(texture2D(u_depthMap, hs_mapUv(center)), hs_receiver);
    HS_COUNT(1);
    if (gap >= min(dot(hs_gradient, center - hs_texel), 0.0) - u_bias.x - u_bias.y * slope) return 1.0;
    widths.x = max(widths.x, u_kernel.x * -gap);
    leastInside = 0.0;
    corners = 0.0;
  }
  return hs_litByEdge(stored, widths.x, corners, leastInside);
}

float hs_meanOfWidths() {
  float lit = 0.0;
  float seen = 0.0;
  float all = 0.0;
  HS_HIGHP float turn = 0.0;
  HS_HIGHP vec2 part = vec2(0.0);
  // An end that compilers do not know: nine turns in a row are more than many devices have room for.
  HS_HIGHP float end = float(HS_PARTS) - 0.5 + min(u_map.x, 0.0);
  for (int i = 0; i < HS_MORE_THAN_UNROLLED; ++i) {
    if (turn > end) break;
    hs_enterSubLight(part.x + part.y * float(HS_SUB_LIGHTS_U));
    float above = hs_subLightAbove();
    all += above;
    // From below the horizon the caster's own body hides the fragment, see penumbra_main.glsl.
    if (above > 0.0 && hs_turned * u_receiver.x >= 0.0) {
      lit += above * hs_litByWidths();
      seen += above;
    }
    turn += 1.0;
    part = hs_partAfter(part, turn);
    bool agreed = all < HS_ALL_DARK || (seen > HS_ALL_LIT && (lit < HS_ALL_DARK || lit > HS_ALL_LIT));
    if (agreed && turn == float(HS_TELLING_PARTS)) {
      all *= float(HS_PARTS) / float(HS_TELLING_PARTS);
      break;
    }
  }
  return lit * (all / max(seen, 1e-3));
}
#else
// Rows of the light's parts are those of the atlas.
#if HS_PARTS > (HS_SUB_LIGHTS_U - 1) * (HS_SUB_LIGHTS_U - 1) && HS_SUB_LIGHTS_V <= HS_SUB_LIGHTS_U
#define HS_ROWS_ALIKE
#endif
uniform HS_HIGHP vec4 u_widthSteps;  // of the atlas per unit of depth between neighbours, xy along u, zw along v
uniform HS_HIGHP vec4 u_widthFirst;  // of the atlas: xy: per depth texel, zw: margin of the first map
// Places in the atlas are counted on from one sub-light to the next.
float hs_meanOfWidths() {
  HS_HIGHP vec4 steps = u_widthSteps * (hs_receiverValue - u_subLights.x);
  HS_HIGHP vec2 uv = hs_texel * u_widthFirst.xy + u_widthFirst.zw - 0.5 * float(HS_SUB_LIGHTS_U - 1) * steps.xy -
                     0.5 * float(HS_SUB_LIGHTS_V - 1) * steps.zw;
  HS_HIGHP vec2 nextRow = steps.zw - float(HS_SUB_LIGHTS_U) * steps.xy;
  HS_HIGHP vec2 corner = vec2(0.0);
#ifndef HS_ROWS_ALIKE
  HS_HIGHP float column = 0.0;
#endif
  float lit = 0.0;
  // An end that compilers do not know: nine turns in a row are more than many devices have room for.
  HS_HIGHP float left = float(HS_SUB_LIGHTS_U * HS_SUB_LIGHTS_V) - 0.5 + min(u_map.x, 0.0);
  for (int i = 0; i < HS_MORE_THAN_UNROLLED; ++i) {
    if (left < 0.0) break;
    // What is the same in all turns and costs little is found in each, from uniforms that are not read before: registers
    // are few.
    HS_HIGHP vec2 tile = u_widthTile.xy * u_widthLayout.zw;
    HS_HIGHP vec2 low = 0.5 * u_widthLayout.zw;
    HS_HIGHP vec4 stored = texture2D(u_widthMap, corner + clamp(uv, low, tile - low));
    HS_COUNT(1);
    HS_HIGHP vec2 widths = hs_widestKernels() - u_kernel.y * stored.b;
    lit += hs_litByEdge(stored, widths.x, hs_cornerWeight(widths), -1.0);
    left -= 1.0;
    corner.x += tile.x;
    HS_HIGHP float ends = step(1.0 - low.x, corner.x);
    corner += ends * vec2(-1.0, tile.y);
#ifndef HS_ROWS_ALIKE
    column += 1.0;
    ends = step(float(HS_SUB_LIGHTS_U) - 0.5, column);
    column -= ends * float(HS_SUB_LIGHTS_U);
#endif
    uv += steps.xy + ends * nextRow;
  }
  return lit;
}
#endif

float hs_meanVisibility() { return hs_meanOfWidths() * (1.0 / float(HS_PARTS)); }
