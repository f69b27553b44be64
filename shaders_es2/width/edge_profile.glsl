// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Of a split light's map: shares of a square kernel by the distance to a straight edge alone. Edges are taken to have the
// direction halfway between a side and a diagonal: over several sub-lights the difference is not measurable.
// Side of a sub-light in texels: x: per unit of depth, y: over the range of casters' depths, z: for the nearest caster and
// the farthest receiver; w: 1 where the map holds what edges miss, else 0.
uniform HS_HIGHP vec4 u_kernel;

// The smaller of the parts into which an edge cuts the kernel, at a distance in its sides: growing by the square over a
// corner, then evenly.
HS_HIGHP float hs_smallerPart(HS_HIGHP float distance) {
  HS_HIGHP float beyond = max(0.6533 - distance, 0.0);
  HS_HIGHP float corner = min(beyond, 0.3827);
  return 1.4142 * corner * corner + 1.0824 * (beyond - corner);
}
