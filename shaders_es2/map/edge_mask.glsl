// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The paper's mask: zero where no edge lies within the kernel's reach.
uniform HS_HIGHP sampler2D u_edgeMask;

vec4 hs_edges() {
  HS_COUNT(1);
  return texture2D(u_edgeMask, hs_texel * u_map.y);
}

// 0 or 1 from a single tap away from edges, -1 where the filter decides.
float hs_maskClass() {
  if (hs_lightMisses) return 1.0;
  if (hs_edges().a > 0.0) return -1.0;
  return hs_hardTap();
}
