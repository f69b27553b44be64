// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Axis-aligned boxes in double.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>

#include "scene/mesh.hpp"

namespace halfshadow::scene {

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
  bool empty() const { return !(low.x <= high.x); }
  void include(const glm::dvec3& point) { low = glm::min(low, point), high = glm::max(high, point); }
  void include(const Bounds& other) {
    if (!other.empty()) low = glm::min(low, other.low), high = glm::max(high, other.high);
  }
  bool meets(const Bounds& other, double margin = 0.0) const {
    return glm::all(glm::lessThanEqual(low - margin, other.high)) &&
           glm::all(glm::lessThanEqual(other.low - margin, high));
  }
  glm::dvec3 center() const { return (low + high) * 0.5; }
  double radius() const { return empty() ? 0.0 : glm::length(high - low) * 0.5; }
  std::array<glm::dvec3, 8> corners() const;
};

Bounds boundsOf(const TriangleMesh& mesh);
/// Box around the transformed box (conservative).
Bounds transformed(const glm::dmat4& targetFromSource, const Bounds& bounds);

}  // namespace halfshadow::scene
