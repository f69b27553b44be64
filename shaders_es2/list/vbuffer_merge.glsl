// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Two casters' occlusions combined, quadrant by quadrant: the shares added, less an estimate of what both
// occlude. Each is taken to be spread over its rectangle, evenly or rising evenly towards its centre of gravity,
// and never denser than solid. Needs vbuffer_edges.glsl.
// Based on: Forest, Barthe, Paulin 2006, section 3.2, and for the centres its section 6.
HS_HIGHP HS_Quads hs_density(HS_Occlusion q) {
  HS_HIGHP HS_Quads area = max(q.right - q.left, 0.0) * max(q.top - q.bottom, 0.0);
  return min(q.share / max(area, 1e-3), 1.0);
}

#ifdef HS_CENTRES
// Integral over [low, high] of the product of both densities along one axis; each has mean 1 between its own
// `from` and `to`. Exact: Simpson's rule of a parabola.
HS_HIGHP HS_Quads hs_commonSpread(HS_HIGHP HS_Quads low, HS_HIGHP HS_Quads high, HS_HIGHP HS_Quads fromA, HS_HIGHP HS_Quads toA,
                              HS_HIGHP HS_Quads centreA, HS_HIGHP HS_Quads fromB, HS_HIGHP HS_Quads toB,
                              HS_HIGHP HS_Quads centreB) {
  HS_HIGHP HS_Quads inverseA = 2.0 / max(toA - fromA, 2e-3), inverseB = 2.0 / max(toB - fromB, 2e-3);
  HS_HIGHP HS_Quads middleA = 0.5 * (fromA + toA), middleB = 0.5 * (fromB + toB);
  HS_HIGHP HS_Quads riseA = clamp(3.0 * (centreA - middleA) * inverseA, -1.0, 1.0) * inverseA;
  HS_HIGHP HS_Quads riseB = clamp(3.0 * (centreB - middleB) * inverseB, -1.0, 1.0) * inverseB;
  HS_HIGHP HS_Quads middle = 0.5 * (low + high);
  HS_HIGHP HS_Quads atLow = (1.0 + riseA * (low - middleA)) * (1.0 + riseB * (low - middleB));
  HS_HIGHP HS_Quads atMiddle = (1.0 + riseA * (middle - middleA)) * (1.0 + riseB * (middle - middleB));
  HS_HIGHP HS_Quads atHigh = (1.0 + riseA * (high - middleA)) * (1.0 + riseB * (high - middleB));
  return max(high - low, 0.0) * (atLow + 4.0 * atMiddle + atHigh) * (1.0 / 6.0);
}
#endif

// Share that both occlude.
HS_HIGHP HS_Quads hs_overlap(HS_Occlusion a, HS_Occlusion b) {
  HS_HIGHP HS_Quads left = max(a.left, b.left), right = min(a.right, b.right);
  HS_HIGHP HS_Quads bottom = max(a.bottom, b.bottom), top = min(a.top, b.top);
  HS_HIGHP HS_Quads area = max(right - left, 0.0) * max(top - bottom, 0.0);
#ifdef HS_CENTRES
  // Where both concentrate, more than evenly spread; never more than the rectangle.
  HS_HIGHP HS_Quads spread =
      hs_commonSpread(left, right, a.left, a.right, a.centreX, b.left, b.right, b.centreX) *
      hs_commonSpread(bottom, top, a.bottom, a.top, a.centreY, b.bottom, b.top, b.centreY);
  return min(hs_density(a) * hs_density(b) * spread, area);
#else
  return hs_density(a) * hs_density(b) * area;
#endif
}

HS_Occlusion hs_merge(HS_Occlusion a, HS_Occlusion b) {
  HS_Occlusion q;
  HS_HIGHP HS_Quads sum = a.share + b.share;
  q.share = clamp(sum - hs_overlap(a, b), max(a.share, b.share), min(sum, 1.0));
  q.left = min(a.left, b.left);
  q.right = max(a.right, b.right);
  q.bottom = min(a.bottom, b.bottom);
  q.top = max(a.top, b.top);
#ifdef HS_CENTRES
  // What both occlude counts once, in the middle of the common rectangle.
  HS_HIGHP HS_Quads twice = 0.5 * (sum - q.share), divisor = max(q.share, 1e-3);
  HS_HIGHP HS_Quads middleX = max(a.left, b.left) + min(a.right, b.right);
  HS_HIGHP HS_Quads middleY = max(a.bottom, b.bottom) + min(a.top, b.top);
  q.centreX = clamp((a.share * a.centreX + b.share * b.centreX - twice * middleX) / divisor, q.left,
                    max(q.left, q.right));
  q.centreY = clamp((a.share * a.centreY + b.share * b.centreY - twice * middleY) / divisor, q.bottom,
                    max(q.bottom, q.top));
#endif
  return q;
}

#ifdef HS_SIDES
// Two sides of a sheet: the one that occludes more counts, in a rectangle around both.
HS_Occlusion hs_largerOf(HS_Occlusion a, HS_Occlusion b) {
  HS_Occlusion q;
  q.share = max(a.share, b.share);
  q.left = min(a.left, b.left);
  q.right = max(a.right, b.right);
  q.bottom = min(a.bottom, b.bottom);
  q.top = max(a.top, b.top);
#ifdef HS_CENTRES
  HS_HIGHP HS_Quads second = step(a.share, b.share);
  q.centreX = mix(a.centreX, b.centreX, second);
  q.centreY = mix(a.centreY, b.centreY, second);
#endif
  return q;
}
#endif
