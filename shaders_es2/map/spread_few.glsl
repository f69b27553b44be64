// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What spread_places.glsl, spread_taps.glsl and the sums over them do, for devices without highp that have few
// registers: the same places and comparisons, in which little outlives a turn. HS_SHORT without highp asks for it.
//
// A turn's places follow from its number; what is compared with is folded into what turns bytes into gaps, so that of a
// tap two numbers are left: whole steps of the high byte, and the rest with the bias in it.
#if defined(HS_SHORT) && defined(HS_NO_HIGHP)
#define HS_FEW_REGISTERS
HS_HIGHP vec2 hs_fewMiddle;    // of the rectangle, texture coordinates
HS_HIGHP vec2 hs_fewWidth;     // its sides in texels
HS_HIGHP vec2 hs_fewRounding;  // x: of the high byte, y: of the rest
#ifdef HS_SUB_LIGHTS_U
HS_HIGHP vec2 hs_fewCorner;    // of the map that the fragment looks at, texture coordinates
#define HS_FEW_PITCH u_subLights.z
#else
#define HS_FEW_PITCH u_map.y
#endif
// More than 17 a side take: an end that compilers know, but do not unroll.
#define HS_FEW_TURNS 96

// width: sides of the rectangle in texels.
void hs_beginFew(HS_HIGHP vec2 width, HS_HIGHP float bias) {
  hs_fewWidth = width;
#ifdef HS_SUB_LIGHTS_U
  hs_fewCorner = hs_tile * (u_map.x * u_subLights.z);
  hs_fewMiddle = hs_fewCorner + hs_texel * u_subLights.z;
#else
  // Not from hs_texel: compilers would keep both, to add to either what comes cheaper.
  hs_fewMiddle = v_map.xy / v_map.w;
#endif
  hs_fewRounding = vec2(0.5 - hs_receiver.x, bias - hs_receiver.y * (1.0 / 256.0));
}

// x: whole steps by which what is stored there lies beyond the receiver, y: the rest and the bias
HS_HIGHP vec2 hs_fewTap(HS_HIGHP vec2 uv) {
  HS_COUNT(1);
#ifdef HS_SUB_LIGHTS_U
  uv = clamp(uv, hs_fewCorner + 0.5 * u_subLights.z, hs_fewCorner + (u_map.x - 0.5) * u_subLights.z);
#endif
  HS_HIGHP vec2 gap = texture2D(u_depthMap, uv).rg * vec2(255.0, 255.0 / 256.0) + hs_fewRounding;
  gap.x = floor(gap.x);
  return gap;
}

// plane: the receiver's plane there, less the receiver.
void hs_addLit(inout HS_HIGHP float lit, HS_HIGHP vec2 uv, HS_HIGHP float plane) {
  HS_HIGHP vec2 gap = hs_fewTap(uv);
  lit += step(min(plane, 0.0) - gap.x, gap.y);
}
void hs_addLitPair(inout HS_HIGHP float lit, HS_HIGHP vec2 texels) {
  HS_HIGHP float plane = dot(hs_gradient, texels);
  HS_HIGHP vec2 uv = texels * HS_FEW_PITCH;
  hs_addLit(lit, hs_fewMiddle + uv, plane);
  hs_addLit(lit, hs_fewMiddle - uv, -plane);
}

// found: x: taps that block, y: sum of their gaps and biases.
void hs_addBlocking(inout HS_HIGHP vec2 found, HS_HIGHP vec2 uv, HS_HIGHP float plane) {
  HS_HIGHP vec2 gap = hs_fewTap(uv);
  HS_HIGHP float whole = gap.x + gap.y;
  HS_HIGHP float blocks = whole < min(plane, 0.0) ? 1.0 : 0.0;
  found.x += blocks;
  found.y += blocks * whole;
}
void hs_addBlockingPair(inout HS_HIGHP vec2 found, HS_HIGHP vec2 texels) {
  HS_HIGHP float plane = dot(hs_gradient, texels);
  HS_HIGHP vec2 uv = texels * HS_FEW_PITCH;
  hs_addBlocking(found, hs_fewMiddle + uv, plane);
  hs_addBlocking(found, hs_fewMiddle - uv, -plane);
}

// A turn's place, in sides of the rectangle from its middle: how far outward, and beside it; the turn's others are quarter
// turns of it. spacing: 1 / number of all.
HS_HIGHP float hs_fewOutward(HS_HIGHP float turn, HS_HIGHP float spacing) { return (2.0 * turn + 0.5) * spacing; }
HS_HIGHP float hs_fewBeside(HS_HIGHP float turn) { return 0.5 * fract(turn * 0.6263 + 0.31315); }
HS_HIGHP float hs_fewSpacing(HS_HIGHP float side) { return 0.25 / floor(0.25 * side * side); }

// See spread_taps.glsl: width: sides of the rectangle in texels; side x side places.
float hs_spreadSum(HS_HIGHP vec2 width, HS_HIGHP float side, HS_HIGHP float bias) {
  hs_beginFew(width, bias);
  // A value of its own: compilers spill one that lives through the search's loop and this one.
  hs_fewRounding = max(hs_fewRounding, vec2(-512.0));
  HS_HIGHP float spacing = hs_fewSpacing(side);
  HS_HIGHP float lit = 0.0;
  for (int i = 0; i < HS_FEW_TURNS; ++i) {
    HS_HIGHP float outward = hs_fewOutward(float(i), spacing);
    if (outward > 0.5) break;
    HS_HIGHP vec2 place = vec2(outward, hs_fewBeside(float(i)));
    hs_addLitPair(lit, place * hs_fewWidth);
    hs_addLitPair(lit, vec2(-place.y, place.x) * hs_fewWidth);
  }
  return lit * spacing;
}

// See blocker_search.glsl.
HS_HIGHP vec2 hs_searchTaps(HS_HIGHP vec2 asked, HS_HIGHP float side) {
  HS_HIGHP float bias = u_bias.x + u_bias.z * (abs(hs_gradient.x) + abs(hs_gradient.y));
  hs_beginFew(max(asked, vec2(1.0)), bias);
  HS_HIGHP float spacing = hs_fewSpacing(side);
  HS_HIGHP vec2 found = vec2(0.0);
  for (int i = 0; i < HS_FEW_TURNS; ++i) {
    HS_HIGHP float outward = hs_fewOutward(float(i), spacing);
    if (outward > 0.5) break;
    HS_HIGHP vec2 place = vec2(outward, hs_fewBeside(float(i)));
    hs_addBlockingPair(found, place * hs_fewWidth);
    hs_addBlockingPair(found, vec2(-place.y, place.x) * hs_fewWidth);
  }
  // The bias in other words: one that is kept would take a register through the loop.
  return vec2(found.x * spacing, u_bias.x + dot(abs(hs_gradient), u_bias.zz) - found.y / max(found.x, 1.0));
}
#endif
