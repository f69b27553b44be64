// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Light space (see LightFit): the frame of an area light, without a fitted view.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "scene/bounds.hpp"
#include "scene/light.hpp"

namespace halfshadow::planner {

struct LightSpace {
  glm::dvec3 axisX{1, 0, 0}, axisY{0, 1, 0}, axisZ{0, 0, 1};  ///< world directions, orthonormal, z = x × y
  glm::dvec3 originWorld{0.0};                                ///< the light's centre
  glm::dvec2 halfSize{0.0};  ///< of the smallest rectangle along x and y that holds the light, world units

  /// Subtracts the centre before it rotates: no digits are lost far from the world's origin.
  glm::dvec3 lightFromWorld(const glm::dvec3& pointWorld) const {
    const glm::dvec3 d = pointWorld - originWorld;
    return {glm::dot(axisX, d), glm::dot(axisY, d), glm::dot(axisZ, d)};
  }
  glm::dmat4 matrix() const;
  /// Box in light space around a world box.
  scene::Bounds boundsLight(const scene::Bounds& boundsWorld) const;
};

/// A light of zero size gets a frame that depends on `emission` alone; y is along halfV when it is
/// perpendicular to halfU, else z × halfU.
LightSpace lightSpace(const scene::AreaLight& light);

/// Corners of the light, relative to its centre, world units.
std::array<glm::dvec3, 4> lightCornersRelative(const scene::AreaLight& light);

}  // namespace halfshadow::planner
