// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Share of a rectangle on the inner side of a straight line. signedDistance: of its middle from the line; reach: its sides
// as far as they lie across the line, in the same unit.
HS_HIGHP float hs_shareInside(HS_HIGHP float signedDistance, HS_HIGHP vec2 reach) {
  HS_HIGHP float longer = max(max(reach.x, reach.y), 1e-3);
  HS_HIGHP float ratio = max(min(reach.x, reach.y) / longer, 1e-3);
  HS_HIGHP float size = abs(signedDistance) / longer;
  HS_HIGHP float tail = max(0.5 + 0.5 * ratio - size, 0.0);
  HS_HIGHP float share = size <= 0.5 - 0.5 * ratio ? 0.5 + size : 1.0 - tail * tail / (2.0 * ratio);
  return signedDistance < 0.0 ? 1.0 - share : share;
}
