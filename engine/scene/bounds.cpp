// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/bounds.hpp"

namespace halfshadow::scene {

std::array<glm::dvec3, 8> Bounds::corners() const {
  std::array<glm::dvec3, 8> result;
  for (unsigned i = 0; i < 8; ++i) {
    result[i] = {i & 1u ? high.x : low.x, i & 2u ? high.y : low.y, i & 4u ? high.z : low.z};
  }
  return result;
}

Bounds boundsOf(const TriangleMesh& mesh) {
  Bounds bounds;
  for (const std::uint32_t index : mesh.indices) bounds.include(glm::dvec3(mesh.positions[index]));
  return bounds;
}

Bounds transformed(const glm::dmat4& targetFromSource, const Bounds& bounds) {
  Bounds result;
  if (bounds.empty()) return result;
  for (const glm::dvec3& corner : bounds.corners()) {
    result.include(glm::dvec3(targetFromSource * glm::dvec4(corner, 1.0)));
  }
  return result;
}

}  // namespace halfshadow::scene
