// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scene {

/// A caster's mesh where it stands.
struct PlacedCaster {
  const HalfEdgeMesh* mesh = nullptr;
  glm::dmat4 worldFromObject{1.0};
  std::uint32_t object = 0;    ///< the caller's number
  std::uint64_t revision = 0;  ///< of mesh and place, which no other caster has; 0 = not known

  glm::dvec3 objectFromWorld(const glm::dvec3& pointWorld) const {
    return glm::inverse(glm::dmat3(worldFromObject)) * (pointWorld - glm::dvec3(worldFromObject[3]));
  }
};

}  // namespace halfshadow::scene
