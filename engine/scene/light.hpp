// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Rectangular area lights.
#pragma once

#include <glm/glm.hpp>

#include "base/error.hpp"

namespace halfshadow::scene {

/// The points centerWorld + a·halfU + b·halfV, a and b in [-1, 1]; shines into the half-space on the side of
/// cross(halfU, halfV). A light of no size (both vectors zero) shines into the half-space on the side of
/// `emission`; every technique then converges to hard shadows. Nothing behind the light's plane is lit by it;
/// visibility is 1 there by convention.
struct AreaLight {
  glm::dvec3 centerWorld{0.0};
  glm::dvec3 halfU{0.0};
  glm::dvec3 halfV{0.0};
  glm::dvec3 emission{0.0, -1.0, 0.0};  ///< unit; kept for lights whose half vectors vanish
  glm::vec3 color{1.0f};                ///< linear, relative
  double intensity = 1.0;  ///< of lit surfaces at referenceDistance; from there it falls with the square
  /// World units; 0: the intensity is the same at every distance. Never taken from what the scene holds, so
  /// that nothing but the light and the place of a surface decides how bright that is lit.
  double referenceDistance = 0.0;
  /// Half angles about `emission` of a spot: full light inside the inner, none outside the outer cone; an
  /// outer angle of 0: no cone. 0 <= inner < outer <= pi / 2. Of shading alone.
  double innerConeRadians = 0.0, outerConeRadians = 0.0;

  bool operator==(const AreaLight&) const = default;
};

/// Light given by centre, half-extent vectors; both zero is a point that shines downward, -y, as `emission`
/// says. Errors: invalidLight (NaN or infinite; u and v parallel, or one of them zero: a line has no side).
Result<AreaLight> areaLightFromVectors(glm::dvec3 centerWorld, glm::dvec3 halfU, glm::dvec3 halfV);

/// Light at `centerWorld` aimed at `targetWorld`, full side lengths sizeU × sizeV. With n the aim,
/// u = norm(up × n), v = n × u; its intensity counts fully at the target's distance. `up` parallel to the aim
/// is replaced by the axis least aligned with it. Both sizes zero is a point that shines to the target's
/// side. Errors: invalidLight (NaN, infinite, negative size, one size zero, centre equal to target).
Result<AreaLight> areaLightAimed(glm::dvec3 centerWorld, glm::dvec3 targetWorld, double sizeU, double sizeV,
                                 glm::dvec3 up);

/// Unit emission direction.
glm::dvec3 emissionDirection(const AreaLight& light);

}  // namespace halfshadow::scene
