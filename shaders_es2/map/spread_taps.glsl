// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Taps around the fragment, many a turn of a loop: what they have in common is found once, in texture coordinates.
// Compared as in shadow_tap.glsl, which it needs.
HS_HIGHP vec2 hs_tapMiddle, hs_tapScale;  // of the rectangle, and its sides
HS_HIGHP vec2 hs_tapGradient;             // of the receiver's plane over the sides
HS_HIGHP float hs_tapLeast;               // what a tap in the middle must not be below
#ifdef HS_SUB_LIGHTS_U
HS_HIGHP vec2 hs_tapLow, hs_tapHigh;      // of the map that the fragment looks at
#endif
#ifdef HS_DEPTH_PACKED16
HS_HIGHP vec2 hs_tapRounding;
#endif

// Taps are anywhere inside texels. A receiver that is not in the map itself needs no more slack than one in the middle;
// a host's program draws both kinds.
HS_HIGHP float hs_spreadBias() {
#if defined(HS_CASTING_RECEIVER) || defined(HS_SHORT) || defined(HS_FORWARD)
  HS_HIGHP float perGradient = u_bias.z;
#else
  HS_HIGHP float perGradient = u_bias.y;
#endif
  return u_bias.x + perGradient * (abs(hs_gradient.x) + abs(hs_gradient.y));
}

// width: sides of the rectangle in texels.
void hs_beginTaps(HS_HIGHP vec2 width, HS_HIGHP float bias) {
#ifdef HS_SUB_LIGHTS_U
  HS_HIGHP vec2 corner = hs_tile * (u_map.x * u_subLights.z);
  hs_tapLow = corner + 0.5 * u_subLights.z;
  hs_tapHigh = corner + (u_map.x - 0.5) * u_subLights.z;
  hs_tapMiddle = corner + hs_texel * u_subLights.z;
  hs_tapScale = width * u_subLights.z;
#else
  hs_tapMiddle = hs_texel * u_map.y;
  hs_tapScale = width * u_map.y;
#endif
  hs_tapGradient = hs_gradient * width;
#ifdef HS_DEPTH_PACKED16
  hs_tapRounding = 0.5 - hs_receiver;
  hs_tapLeast = -bias;
#else
  hs_tapLeast = hs_receiver - bias;
#endif
}

HS_HIGHP vec4 hs_storedTap(HS_HIGHP vec2 offset) {
  HS_COUNT(1);
#ifdef HS_SUB_LIGHTS_U
  return texture2D(u_depthMap, clamp(hs_tapMiddle + offset, hs_tapLow, hs_tapHigh));
#else
  return texture2D(u_depthMap, hs_tapMiddle + offset);
#endif
}

// What is stored at an offset from the middle: without highp its gap, else its depth.
HS_HIGHP float hs_tap(HS_HIGHP vec2 offset) {
#ifdef HS_DEPTH_PACKED16
  vec2 difference = floor(hs_storedTap(offset).rg * 255.0 + hs_tapRounding);
  return difference.x + difference.y * (1.0 / 256.0);
#else
  return hs_depthValue(hs_storedTap(offset));
#endif
}
// Of two opposite offsets.
HS_HIGHP vec2 hs_tapPair(HS_HIGHP vec2 offset) {
#ifdef HS_DEPTH_PACKED16
  vec4 stored = vec4(hs_storedTap(offset).rg, hs_storedTap(-offset).rg);
  vec4 difference = floor(stored * 255.0 + hs_tapRounding.xyxy);
  return difference.xz + difference.yw * (1.0 / 256.0);
#else
  return vec2(hs_depthValue(hs_storedTap(offset)), hs_depthValue(hs_storedTap(-offset)));
#endif
}

// plane: the receiver's plane there, less the receiver.
float hs_litTap(HS_HIGHP vec2 offset, HS_HIGHP float plane) {
  return step(min(hs_tapLeast + plane, hs_tapLeast), hs_tap(offset));
}
// Of four taps: a place, in sides of the rectangle from its middle, and the quarter turns of it.
float hs_litTaps(HS_HIGHP vec2 place) {
  HS_HIGHP vec2 planes = vec2(dot(hs_tapGradient, place), hs_tapGradient.y * place.x - hs_tapGradient.x * place.y);
  HS_HIGHP vec4 taps = vec4(hs_tapPair(place * hs_tapScale), hs_tapPair(vec2(-place.y, place.x) * hs_tapScale));
  return dot(step(min(hs_tapLeast + vec4(planes, -planes).xzyw, hs_tapLeast), taps), vec4(1.0));
}

// x: does what is stored block, y: its gap if so
HS_HIGHP vec2 hs_blockingTap(HS_HIGHP vec2 offset, HS_HIGHP float plane) {
  HS_HIGHP float tap = hs_tap(offset);
  HS_HIGHP float blocks = 1.0 - step(min(hs_tapLeast + plane, hs_tapLeast), tap);
#ifndef HS_DEPTH_PACKED16
  tap -= hs_receiver;
#endif
  return blocks * vec2(1.0, tap);
}
HS_HIGHP vec2 hs_blockingTaps(HS_HIGHP vec2 place) {
  HS_HIGHP vec2 planes = vec2(dot(hs_tapGradient, place), hs_tapGradient.y * place.x - hs_tapGradient.x * place.y);
  HS_HIGHP vec4 taps = vec4(hs_tapPair(place * hs_tapScale), hs_tapPair(vec2(-place.y, place.x) * hs_tapScale));
  HS_HIGHP vec4 blocks = 1.0 - step(min(hs_tapLeast + vec4(planes, -planes).xzyw, hs_tapLeast), taps);
#ifndef HS_DEPTH_PACKED16
  taps -= hs_receiver;
#endif
  return vec2(dot(blocks, vec4(1.0)), dot(blocks, taps));
}
