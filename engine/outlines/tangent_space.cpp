// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/tangent_space.hpp"

namespace halfshadow::outlines {

glm::dmat4 ListSpace::homogeneousFromWorld() const {
  const glm::dvec3 offset = plane.fromWorld(glm::dvec3(0.0));
  glm::dmat4 rows(0.0);
  for (int column = 0; column < 3; ++column) {
    const glm::dvec3& axis = plane.axes[column];
    rows[column] = {axis.x - originT.x * axis.z, axis.y - originT.y * axis.z, -originI * axis.z, axis.z};
  }
  rows[3] = {offset.x - originT.x * offset.z, offset.y - originT.y * offset.z, 1.0 - originI * offset.z,
             offset.z};
  return rows;
}

}  // namespace halfshadow::outlines
