// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Mean gap between the receiver and what blocks it, from HS_SEARCH x HS_SEARCH taps over a rectangle of the map.
// Based on: Fernando, "Percentage-Closer Soft Shadows", 2005 (blocker search). A tap counts only inside the
// penumbra's width at its own depth: farther off it touches no ray to the light, however wide a nearer caster makes
// the search. Needs penumbra_bounds.glsl.
// width: sides in texels. Returns x: share of taps that block, y: mean distance in depth from blocker to receiver.
HS_HIGHP vec2 hs_searchBlockers(HS_HIGHP vec2 width) {
  HS_HIGHP float bias = u_bias.x + u_bias.z * (abs(hs_gradient.x) + abs(hs_gradient.y));
  HS_HIGHP vec2 stride = max(width, vec2(1.0)) * (1.0 / float(HS_SEARCH));
  HS_HIGHP vec2 first = -0.5 * float(HS_SEARCH - 1) * stride;
  HS_HIGHP vec2 offset = first;
  float column = 0.0;
  float blockers = 0.0;
  HS_HIGHP float gapSum = 0.0;
  for (int i = 0; i < HS_SEARCH * HS_SEARCH; ++i) {
    HS_HIGHP float gap = hs_gap(texture2D(u_depthMap, (hs_texel + offset) * u_map.y), hs_receiver);
    HS_COUNT(1);
    HS_HIGHP vec2 inside = step(abs(offset), max(vec2(0.5), -0.5 * gap * u_penumbra.xy));
    HS_HIGHP float blocks = (1.0 - step(min(dot(hs_gradient, offset), 0.0) - bias, gap));
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
