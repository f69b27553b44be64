// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What lies beyond one side of a light for all receivers of a tile. Asked for each facet and vertex of each
/// tile, and therefore inline.
#pragma once

#include "outlines/tangent_space.hpp"

namespace halfshadow::outlines {

/// The four half-planes outside a sub-light as bounds for one receiver set: a vertex E lies beyond the side
/// x > X w for every receiver when E.t.x - X·E.i > bound, since t and i are linear in E and in P.
class OuterSides {
 public:
  OuterSides(const SubLight& light, const TangentBox& receivers);
  /// Bits 0-3: beyond the right, left, upper, lower side for all receivers.
  unsigned code(const glm::vec3& ti) const {
    return (ti.x - right_ * ti.z > rightBound_ ? 1u : 0u) | (ti.x - left_ * ti.z < leftBound_ ? 2u : 0u) |
           (ti.y - upper_ * ti.z > upperBound_ ? 4u : 0u) | (ti.y - lower_ * ti.z < lowerBound_ ? 8u : 0u);
  }
  /// Sides beyond which an edge covers no part of any cell: cells count x from their left side, within their
  /// rows.
  static constexpr unsigned kCoversNothing = 2u | 4u | 8u;
  /// The same for all points of a box at once; 0 when no side has all of it.
  unsigned code(const glm::vec3& low, const glm::vec3& high) const {
    const auto smallest = [&](float t, float side) { return t - side * (side > 0.0f ? high.z : low.z); };
    const auto largest = [&](float t, float side) { return t - side * (side > 0.0f ? low.z : high.z); };
    return (smallest(low.x, right_) > rightBound_ ? 1u : 0u) |
           (largest(high.x, left_) < leftBound_ ? 2u : 0u) |
           (smallest(low.y, upper_) > upperBound_ ? 4u : 0u) |
           (largest(high.y, lower_) < lowerBound_ ? 8u : 0u);
  }

 private:
  float left_, right_, lower_, upper_;
  float leftBound_, rightBound_, lowerBound_, upperBound_;
};

inline OuterSides::OuterSides(const SubLight& light, const TangentBox& box)
    : left_(light.center.x - light.half),
      right_(light.center.x + light.half),
      lower_(light.center.y - light.half),
      upper_(light.center.y + light.half) {
  // Largest and smallest t - X i over the box.
  const auto largest = [&](float t, float side) { return t - side * (side > 0.0f ? box.iLow : box.iHigh); };
  const auto smallest = [&](float t, float side) { return t - side * (side > 0.0f ? box.iHigh : box.iLow); };
  rightBound_ = largest(box.tHigh.x, right_);
  leftBound_ = smallest(box.tLow.x, left_);
  upperBound_ = largest(box.tHigh.y, upper_);
  lowerBound_ = smallest(box.tLow.y, lower_);
}

}  // namespace halfshadow::outlines
