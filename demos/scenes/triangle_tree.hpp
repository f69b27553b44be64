// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A scene's triangles in a tree of boxes, for the few rays that placing a ground, a lamp and a near plane
/// asks (internal).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "scene/scene_description.hpp"

namespace halfshadow::scenes {

struct WorldTriangle {
  std::array<glm::dvec3, 3> corners;
  std::uint32_t object = 0, shell = scene::kNoShell;
  double area() const {
    return 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  }
};

class TriangleTree {
 public:
  explicit TriangleTree(const scene::SceneDescription& description);

  /// In any order, which order() or the first ray settles.
  const std::vector<WorldTriangle>& triangles() const { return triangles_; }

  void order() const {
    if (nodes_.empty() && !triangles_.empty()) addNode(0, static_cast<std::uint32_t>(triangles_.size()));
  }

  struct Hit {
    double share = std::numeric_limits<double>::infinity();  ///< of the way; infinite: nothing is met
    const WorldTriangle* triangle = nullptr;
  };
  /// What the segment from `start` meets first before start + way, but for `own`; either side of a triangle.
  Hit firstOn(const glm::dvec3& start, const glm::dvec3& way, const WorldTriangle* own = nullptr) const;
  /// Whether anything but `own` lies between `start` and `end`, a millionth before the end excluded.
  bool isBetween(const glm::dvec3& start, const glm::dvec3& end, const WorldTriangle* own = nullptr) const;

 private:
  struct Node {
    glm::dvec3 low{0.0}, high{0.0};
    std::uint32_t first = 0, count = 0;  ///< triangles; count 0 = inner, its left child follows it
    std::uint32_t right = 0;
  };
  std::uint32_t addNode(std::uint32_t first, std::uint32_t count) const;

  mutable std::vector<WorldTriangle> triangles_;
  mutable std::vector<Node> nodes_;  ///< made for the first ray: most scenes ask none
};

}  // namespace halfshadow::scenes
