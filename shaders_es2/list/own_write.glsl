// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Leaves the visibility of a receiver that walked its lists on the screen: 16 bits, or how many fetches that took.
void main() {
  hs_onReceiver = hs_readReceiver();
  if (!hs_onReceiver) discard;
  HS_HIGHP float visibility = hs_ownVisibility();
#ifdef HS_COUNT_TAPS
  // Two of the receiver's place.
  HS_HIGHP float low = mod(hs_taps + 2.0, 256.0);
  gl_FragColor = vec4((vec2(low, floor((hs_taps + 2.0) / 256.0)) + 0.25) / 255.0, 0.0, 1.0);
#else
  HS_HIGHP float scaled = floor(clamp(visibility, 0.0, 1.0) * 65280.0 + 0.5);
  HS_HIGHP float high = floor(scaled / 256.0);
  gl_FragColor = vec4((vec2(high, scaled - 256.0 * high) + 0.25) / 255.0, 0.0, 1.0);
#endif
}
