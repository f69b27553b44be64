// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#define HS_BINARY_CLASS  // a class is 0 or 1 where no filter is needed
// The paper's mask: zero where no edge lies within the kernel's reach.
uniform HS_HIGHP sampler2D u_edgeMask;

vec4 hs_edges() {
  HS_COUNT(1);
  return texture2D(u_edgeMask, hs_texel * u_map.y);
}

// 0 or 1 from a single tap away from edges, -1 where the filter decides.
float hs_maskClass() {
  float edge = hs_edges().a, lit = hs_hardTap();
  return hs_lightMisses ? 1.0 : (edge > 0.0 ? -1.0 : lit);
}
