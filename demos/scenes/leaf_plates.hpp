// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Frames of the 70 plates of the scene `leaves` (internal to demos/scenes).
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace halfshadow::scenes {

struct LeafPlate {
  glm::dvec3 centerWorld;
  glm::dvec3 xAxis, yAxis;  ///< unit; z = x × y. Half extents along them: 0.28, 0.012, 0.12.
};

extern const std::array<LeafPlate, 70> kLeafPlates;

}  // namespace halfshadow::scenes
