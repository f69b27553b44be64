// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Offsets from texels beside a silhouette to the silhouette itself: where the coverage, linear between texel
// centres, crosses one half along either axis; with two crossings, the nearest point of the line through both.
#include "width/width_offset.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_coverage;
uniform HS_HIGHP vec4 u_widthLayout;  // xy: texels per side, zw: 1 / xy

// Signed distance along one axis to the nearer crossing towards either neighbour; 2 = none.
HS_HIGHP float hs_crossing(HS_HIGHP float here, HS_HIGHP float before, HS_HIGHP float after) {
  HS_HIGHP float side = here - 0.5;
  HS_HIGHP float towardsAfter = side * (after - 0.5) <= 0.0 && after != here ? side / (here - after) : 2.0;
  HS_HIGHP float towardsBefore = side * (before - 0.5) <= 0.0 && before != here ? side / (here - before) : 2.0;
  return towardsBefore < towardsAfter ? -towardsBefore : towardsAfter;
}

void main() {
  HS_HIGHP vec2 center = (floor(v_uv * u_widthLayout.xy) + 0.5) * u_widthLayout.zw;
  HS_HIGHP vec2 s = vec2(u_widthLayout.z, 0.0);
  HS_HIGHP vec2 t = vec2(0.0, u_widthLayout.w);
  HS_HIGHP float here = texture2D(u_coverage, center).r;
  HS_HIGHP vec2 crossing =
      vec2(hs_crossing(here, texture2D(u_coverage, center - s).r, texture2D(u_coverage, center + s).r),
           hs_crossing(here, texture2D(u_coverage, center - t).r, texture2D(u_coverage, center + t).r));
  bool alongX = crossing.x < 1.5;
  bool alongY = crossing.y < 1.5;
  if (!alongX && !alongY) {
    gl_FragColor = vec4(0.0);
    return;
  }
  HS_HIGHP vec2 offset = vec2(0.0);
  if (alongX && alongY) {
    // Foot of the perpendicular on x / cx + y / cy = 1.
    HS_HIGHP float lengths = dot(crossing, crossing);
    offset = lengths < 1e-4 ? vec2(0.0) : crossing.yx * (crossing.x * crossing.y / lengths);
  } else {
    offset = alongX ? vec2(crossing.x, 0.0) : vec2(0.0, crossing.y);
  }
  gl_FragColor = hs_packOffset(offset);
}
