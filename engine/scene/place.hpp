// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How far from the origin anything may be.
#pragma once

#include <glm/glm.hpp>

namespace halfshadow::scene {

/// Along each axis, world units. Products of four lengths still fit double precision, and what is taken
/// relative to the light or the camera fits single precision.
inline constexpr double kFarthestPlace = 1e30;

/// False of NaN, too.
inline bool isPlace(const glm::dvec3& p) {
  return glm::all(glm::lessThanEqual(glm::abs(p), glm::dvec3(kFarthestPlace)));
}

}  // namespace halfshadow::scene
