// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Where the receivers' facets face, on their side towards the eye, in world axes: a point on an octahedron, 16 bits along
// each of its two axes, of which 0 and the ends are exact.
#include "receiver/alpha_mask.glsl"
#ifdef HS_FACET_NORMAL
varying HS_HIGHP vec4 v_facet;
#else
varying HS_HIGHP vec3 v_relative;
#endif
void main() {
#ifdef HS_FACET_NORMAL
  HS_HIGHP vec3 n = v_facet.xyz;
#else
  HS_HIGHP vec3 n = cross(dFdx(v_relative), dFdy(v_relative));
  n = dot(n, v_relative) > 0.0 ? -n : n;
#endif
  HS_HIGHP float size = abs(n.x) + abs(n.y) + abs(n.z);
  HS_HIGHP vec2 side = n.xy / (size > 0.0 ? size : 1.0);
  if (n.z < 0.0) side = (1.0 - abs(side.yx)) * vec2(side.x < 0.0 ? -1.0 : 1.0, side.y < 0.0 ? -1.0 : 1.0);
  HS_HIGHP vec2 place = floor(clamp(side, -1.0, 1.0) * 32767.0 + 32767.5);
  HS_HIGHP vec2 high = floor((place + 0.5) / 256.0);
  HS_HIGHP vec2 low = place - 256.0 * high;
  gl_FragColor = (vec4(high.x, low.x, high.y, low.y) + 0.25) / 255.0;
  hs_cut();
}
