// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Mean gap between the receiver and what blocks it, from HS_SEARCH x HS_SEARCH taps over a rectangle of the map.
// Based on: Fernando, "Percentage-Closer Soft Shadows", 2005 (blocker search).
// width: sides in texels; taps: all of them, or 0 for none. Returns x: share of taps that block, y: mean distance in
// depth from blocker to receiver.
HS_HIGHP vec2 hs_searchTaps(HS_HIGHP vec2 width, float taps) {
  HS_HIGHP float bias = u_bias.x + u_bias.z * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP vec2 stride = max(width, vec2(1.0)) * (1.0 / float(HS_SEARCH));
  HS_HIGHP vec2 first = -0.5 * float(HS_SEARCH - 1) * stride;
  HS_HIGHP vec2 offset = first;
  float column = 0.0;
  float blockers = 0.0;
  HS_HIGHP float gapSum = 0.0;
  for (int i = 0; i < HS_SEARCH * HS_SEARCH; ++i) {
    if (float(i) >= taps) break;
    HS_HIGHP float gap = hs_gap(texture2D(u_depthMap, hs_mapUv(hs_texel + offset)), hs_receiver);
    HS_COUNT(1);
    HS_HIGHP float blocks = 1.0 - step(min(dot(hs_gradient, offset), 0.0) - bias, gap);
    blockers += blocks;
    gapSum += blocks * gap;
    column += 1.0;
    float wrapped = step(float(HS_SEARCH) - 0.5, column);
    column -= wrapped * float(HS_SEARCH);
    offset.x = first.x + column * stride.x;
    offset.y += wrapped * stride.y;
  }
  return vec2(blockers * (1.0 / float(HS_SEARCH * HS_SEARCH)), -gapSum / max(blockers, 1.0));
}

// The same over what could hold blockers, and again over what the blockers found ask for as long as that is much less: a
// nearer caster at the rim makes the region wide without being in the way, and so does the upper part of a wall at
// whose foot the receiver lies. Where the light is wholly beyond such a wall, each search at least halves the gap
// until the region ends before the foot; regions wider than that let light in along it.
HS_HIGHP vec2 hs_searchBlockers() {
  HS_HIGHP float asked = hs_widestGap;
  HS_HIGHP vec2 found = hs_searchTaps(hs_kernel * asked, float(HS_SEARCH * HS_SEARCH));
  for (int i = 0; i < 4; ++i) {
    if (found.x <= 0.0 || found.y > 0.75 * asked) break;
    asked = found.y;
    HS_HIGHP vec2 nearer = hs_searchTaps(hs_kernel * asked, float(HS_SEARCH * HS_SEARCH));
    if (nearer.x <= 0.0) break;
    found = nearer;
  }
  return found;
}
