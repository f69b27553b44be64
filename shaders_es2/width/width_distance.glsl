// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Signed distances in one byte: fine near the silhouette, coarse far from it, where the penumbra that needs
// them is wide. Smooth, so that bilinear fetches interpolate.
// range: x: largest distance, y: distance at which the step has doubled twice
HS_HIGHP float hs_packDistance(HS_HIGHP float signedTexels, HS_HIGHP vec2 range) {
  HS_HIGHP float size = min(abs(signedTexels), range.x);
  HS_HIGHP float share = size / (range.y + size) * ((range.y + range.x) / range.x);
  HS_HIGHP float byte = floor(127.0 + 127.0 * (signedTexels < 0.0 ? -share : share) + 0.5);
  return (byte + 0.25) / 255.0;
}

HS_HIGHP float hs_unpackDistance(HS_HIGHP float stored, HS_HIGHP vec2 range) {
  HS_HIGHP float share = clamp((stored * 255.0 - 127.0) * (1.0 / 127.0), -1.0, 1.0);
  return share * range.y / (range.y / range.x + 1.0 - abs(share));
}
