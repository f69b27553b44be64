// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One comparison with the stored depth.
//
// A texel is lit when its stored depth is not nearer than the receiver plane there, less the bias. Where the
// plane lies behind the receiver itself the receiver's own depth decides: a blocker must be nearer to the
// light than the point it shadows, and a plane extended past a silhouette would invent blockers.
uniform HS_HIGHP sampler2D u_depthMap;

// texel: place in the map; planeOffset: dot(hs_gradient, its offset from the receiver's hs_texel), in depth units.
float hs_lit(HS_HIGHP vec2 texel, HS_Depth receiver, HS_HIGHP float planeOffset, HS_HIGHP float bias) {
  HS_COUNT(1);
  return step(min(planeOffset, 0.0) - bias, hs_gap(texture2D(u_depthMap, hs_mapUv(texel)), receiver));
}

float hs_hardTap() {
  HS_HIGHP vec2 center = floor(hs_texel) + 0.5;
  HS_HIGHP float bias = u_bias.x + u_bias.y * (abs(hs_gradient.x) + abs(hs_gradient.y));
  return hs_lit(center, hs_receiver, dot(hs_gradient, center - hs_texel), bias);
}
