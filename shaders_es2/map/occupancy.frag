// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Share of 4 x 4 depth texels that hold a caster, and the casters' mean normalised depth (0 at the nearest caster,
// 1 at the farthest): 16 bits each, for occupancy_level.frag and blocker_pyramid.glsl.
#include "map/depth_storage.glsl"
#include "map/occupancy_storage.glsl"
varying HS_HIGHP vec2 v_uv;
uniform HS_HIGHP sampler2D u_depthMap;
uniform HS_HIGHP vec4 u_sourceSize;  // x: texels per side, y: 1 / x
uniform HS_HIGHP vec4 u_casterRange; // x: depth of the nearest caster, y: 1 / depth range, z: depth of empty texels less a margin

void main() {
  HS_HIGHP vec2 first = (floor(v_uv * u_sourceSize.x * 0.25) * 4.0 + 0.5) * u_sourceSize.y;
  HS_HIGHP vec2 offset = vec2(0.0);
  HS_HIGHP vec2 sum = vec2(0.0);
  for (int i = 0; i < 16; ++i) {
    HS_HIGHP float depth = hs_depthValue(texture2D(u_depthMap, first + offset * u_sourceSize.y));
    HS_HIGHP float occupied = step(depth, u_casterRange.z);
    sum += occupied * vec2(1.0, clamp((depth - u_casterRange.x) * u_casterRange.y, 0.0, 1.0));
    offset.x += 1.0;
    float wrapped = step(3.5, offset.x);
    offset += wrapped * vec2(-4.0, 1.0);
  }
  gl_FragColor = hs_packOccupancy(vec2(sum.x * (1.0 / 16.0), sum.y / max(sum.x, 1.0)));
}
