// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A number of 5 bits of exponent and 19 of mantissa, split into bytes by integer arithmetic and stored a quarter above
// the step, so that targets which round and targets which truncate keep all bits that the arithmetic has. Alpha: a mark, or where the facet faces, on its side towards
// the eye: a point of a grid of 15 x 16 over an octahedron, within 17 degrees.
#include "receiver/alpha_mask.glsl"
varying HS_HIGHP float v_distance;
uniform HS_HIGHP float u_nearestReceiver;  // what is taken off distances
#ifdef HS_FACET_NORMAL
varying HS_HIGHP vec4 v_facet;
uniform HS_HIGHP mat3 u_pixelRay;  // ray of a window position (x, y, 1), 1 along the view axis
#elif defined(HS_FACETS)
varying HS_HIGHP vec3 v_relative;
#endif
#ifdef HS_FACETS
float hs_facetCode() {
#ifdef HS_FACET_NORMAL
  HS_HIGHP vec3 n = v_facet.xyz;
#else
  HS_HIGHP vec3 n = cross(dFdx(v_relative), dFdy(v_relative));
  n = dot(n, v_relative) > 0.0 ? -n : n;
#endif
  HS_HIGHP float size = abs(n.x) + abs(n.y) + abs(n.z);
  HS_HIGHP vec2 side = n.xy / (size > 0.0 ? size : 1.0);
  if (n.z < 0.0) side = (1.0 - abs(side.yx)) * vec2(side.x < 0.0 ? -1.0 : 1.0, side.y < 0.0 ? -1.0 : 1.0);
  HS_HIGHP vec2 cell = floor((0.5 + 0.5 * side) * vec2(14.0, 15.0) + 0.5);
  return cell.x + 15.0 * cell.y + 1.0;
}
#else
uniform HS_HIGHP float u_receiverMark;  // alpha, in 255ths
#endif
void main() {
  HS_HIGHP float along = v_distance;
#ifdef HS_FACET_NORMAL
  // Rasterisers snap vertices, some to a sixteenth of a pixel, and interpolate to match: a narrow penumbra shows that.
  // The pixel's own ray meets the facet's plane where it should, unless the facet is seen edge-on.
  HS_HIGHP float across = dot(v_facet.xyz, u_pixelRay * vec3(gl_FragCoord.xy, 1.0));
  HS_HIGHP float met = v_facet.w / (abs(across) < 1e-20 ? 1e-20 : across);
  along = abs(met - along) < 0.01 * along ? met : along;
#endif
  HS_HIGHP float scaled = clamp(along - u_nearestReceiver, 0.0, 0.9999999);
  // Doubled until it is at least 1/2.
  HS_HIGHP float exponent = 0.0;
  if (scaled < 1.0 / 65536.0) scaled *= 65536.0, exponent += 16.0;
  if (scaled < 1.0 / 256.0) scaled *= 256.0, exponent += 8.0;
  if (scaled < 1.0 / 16.0) scaled *= 16.0, exponent += 4.0;
  if (scaled < 1.0 / 4.0) scaled *= 4.0, exponent += 2.0;
  if (scaled < 1.0 / 2.0) scaled *= 2.0, exponent += 1.0;
  HS_HIGHP float mantissa = max(2.0 * scaled - 1.0, 0.0) * 8.0;
  HS_HIGHP float high = floor(mantissa);
  mantissa = (mantissa - high) * 256.0;
  HS_HIGHP float middle = floor(mantissa);
  HS_HIGHP float low = floor((mantissa - middle) * 256.0);
  high += 8.0 * exponent;
#ifdef HS_FACETS
  float code = hs_facetCode();
#else
  float code = u_receiverMark;
#endif
  gl_FragColor = (vec4(min(high, 255.0), middle, low, code) + 0.25) / 255.0;
  hs_cut();
}
