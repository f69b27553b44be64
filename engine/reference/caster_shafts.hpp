// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Private to the reference: proves that no caster lies between a point and the light, without rays.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/embree_scene.hpp"

namespace halfshadow::reference {

/// The light in trace space.
struct TraceLight {
  glm::dvec3 center{0.0}, halfU{0.0}, halfV{0.0};
  bool hasSize() const { return halfU != glm::dvec3(0.0) || halfV != glm::dvec3(0.0); }
};

/// A box tree over the casters' triangles, asked with the pyramid from a point to the light.
class CasterShafts {
 public:
  explicit CasterShafts(const std::vector<TraceMesh>& casters);

  /// False only if no triangle touches the pyramid whose apex is `origin` and whose base is the light, so
  /// that no ray from the one to the other can hit; true where that is not proved.
  bool mayOcclude(const glm::dvec3& origin, const TraceLight& light) const;

 private:
  struct Triangle {
    std::array<glm::dvec3, 3> corners;
  };
  struct Node {
    glm::dvec3 low{0.0}, high{0.0};
    std::uint32_t first = 0, count = 0;  ///< triangles; count 0 = inner node
    std::uint32_t right = 0;             ///< inner node: its left child follows it directly
  };
  std::uint32_t addNode(std::uint32_t first, std::uint32_t count);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace halfshadow::reference
