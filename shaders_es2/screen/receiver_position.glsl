// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The receiver of this pixel in the coordinates (a, b, h) of a light.
uniform HS_HIGHP sampler2D u_receiverDepth;
uniform HS_HIGHP vec4 u_receiverEye;
uniform HS_HIGHP vec4 u_receiverRay;   // w: the distance that is stored as 0
uniform HS_HIGHP vec4 u_receiverRayX;  // w: 1 / width
uniform HS_HIGHP vec4 u_receiverRayY;  // w: 1 / height

HS_HIGHP vec4 hs_storedReceiver() {
  return texture2D(u_receiverDepth, gl_FragCoord.xy * vec2(u_receiverRayX.w, u_receiverRayY.w));
}
// 1: a receiver of few triangles, where alpha does not tell facets.
HS_HIGHP float hs_markOf(HS_HIGHP vec4 stored) { return 1.0 - step(0.75, stored.a); }

// Halves by powers of two while bits of the exponent, from the highest on, are set.
HS_HIGHP float hs_halved(HS_HIGHP float value, HS_HIGHP float bit, HS_HIGHP float factor) {
  return value * (bit > 0.5 ? factor : 1.0);
}

// Bytes as integers, then the distance in steps that every precision represents, half a step above the stored one.
HS_HIGHP float hs_distanceOf(HS_HIGHP vec4 stored) {
  HS_HIGHP vec3 bytes = floor(stored.rgb * 255.0 + 0.5);
  HS_HIGHP float exponent = floor(bytes.x * 0.125 + 0.0625);
  HS_HIGHP float mantissa = ((bytes.z + 0.5) * (1.0 / 256.0) + bytes.y) * (1.0 / 256.0) + bytes.x - 8.0 * exponent;
  HS_HIGHP float along = 0.5 + mantissa * 0.0625;
  HS_HIGHP float bit = step(15.5, exponent);
  along = hs_halved(along, bit, 1.0 / 65536.0);
  exponent -= 16.0 * bit;
  bit = step(7.5, exponent);
  along = hs_halved(along, bit, 1.0 / 256.0);
  exponent -= 8.0 * bit;
  bit = step(3.5, exponent);
  along = hs_halved(along, bit, 1.0 / 16.0);
  exponent -= 4.0 * bit;
  bit = step(1.5, exponent);
  along = hs_halved(along, bit, 1.0 / 4.0);
  exponent -= 2.0 * bit;
  return hs_halved(along, exponent, 1.0 / 2.0) + u_receiverRay.w;
}
HS_HIGHP vec3 hs_positionOf(HS_HIGHP vec4 stored) {
  HS_HIGHP vec2 window = gl_FragCoord.xy;
  HS_HIGHP vec3 ray = u_receiverRay.xyz + window.x * u_receiverRayX.xyz + window.y * u_receiverRayY.xyz;
  return u_receiverEye.xyz + hs_distanceOf(stored) * ray;
}
HS_HIGHP vec3 hs_receiverPosition() { return hs_positionOf(hs_storedReceiver()); }

// The normal of the facet's visible side in world axes; 0 where none is stored.
HS_HIGHP vec3 hs_facetOf(HS_HIGHP vec4 stored) {
  HS_HIGHP float code = floor(stored.a * 255.0 + 0.5) - 1.0;
  HS_HIGHP float row = floor((code + 0.5) / 15.0);
  HS_HIGHP vec2 side = vec2(code - 15.0 * row, row) / vec2(7.0, 7.5) - 1.0;
  HS_HIGHP vec3 n = vec3(side, 1.0 - abs(side.x) - abs(side.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(side.yx)) * vec2(side.x < 0.0 ? -1.0 : 1.0, side.y < 0.0 ? -1.0 : 1.0);
  return code < 0.0 || code > 239.5 ? vec3(0.0) : normalize(n);
}
