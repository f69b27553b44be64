// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Rectangular area lights.
#pragma once

#include <glm/glm.hpp>

#include "base/error.hpp"

namespace halfshadow::scene {

/// The points centerWorld + a·halfU + b·halfV, a and b in [-1, 1]; emits towards cross(halfU, halfV).
/// A zero-size light (both vectors zero) is a point light along `emission`: every technique then converges
/// to hard shadows.
struct AreaLight {
  glm::dvec3 centerWorld{0.0};
  glm::dvec3 halfU{0.0};
  glm::dvec3 halfV{0.0};
  glm::dvec3 emission{0.0, -1.0, 0.0};  ///< unit; kept for lights whose half vectors vanish
  glm::vec3 color{1.0f};                ///< linear, relative
  double intensity = 1.0;
};

/// Light given by centre, half-extent vectors. Errors: invalidLight (NaN or infinite; u and v parallel while
/// both are non-zero).
Result<AreaLight> areaLightFromVectors(glm::dvec3 centerWorld, glm::dvec3 halfU, glm::dvec3 halfV);

/// Light at `centerWorld` aimed at `targetWorld`, full side lengths sizeU × sizeV. With n the aim,
/// u = norm(up × n), v = n × u. `up` parallel to the aim is replaced by the axis least aligned with it.
/// Errors: invalidLight (NaN, infinite, negative size, centre equal to target).
Result<AreaLight> areaLightAimed(glm::dvec3 centerWorld, glm::dvec3 targetWorld, double sizeU, double sizeV,
                                 glm::dvec3 up);

/// Unit emission direction.
glm::dvec3 emissionDirection(const AreaLight& light);

}  // namespace halfshadow::scene
