// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/light.hpp"

#include <cmath>

#include "scene/place.hpp"

namespace halfshadow::scene {
namespace {
Error notAPlace() {
  return {ErrorCode::invalidLight,
          "the light has a NaN or infinite component, or one beyond 1e30; give smaller, finite numbers"};
}

glm::dvec3 leastAlignedAxis(const glm::dvec3& direction) {
  const glm::dvec3 size = glm::abs(direction);
  if (size.x <= size.y && size.x <= size.z) return {1, 0, 0};
  return size.y <= size.z ? glm::dvec3{0, 1, 0} : glm::dvec3{0, 0, 1};
}
}  // namespace

Result<AreaLight> areaLightFromVectors(glm::dvec3 centerWorld, glm::dvec3 halfU, glm::dvec3 halfV) {
  if (!isPlace(centerWorld) || !isPlace(halfU) || !isPlace(halfV)) return notAPlace();
  AreaLight light{.centerWorld = centerWorld, .halfU = halfU, .halfV = halfV};
  const double lengthU = glm::length(halfU), lengthV = glm::length(halfV);
  const glm::dvec3 normal = glm::cross(halfU, halfV);
  if (lengthU > 0.0 && lengthV > 0.0) {
    // 1e-6 rad: below it the rectangle is a line and its emission side is rounding noise.
    if (glm::length(normal) <= 1e-6 * lengthU * lengthV) {
      return Error{ErrorCode::invalidLight,
                   "the light's u and v are parallel; give two independent half-extents"};
    }
    light.emission = glm::normalize(normal);
  } else if (lengthU > 0.0 || lengthV > 0.0) {
    return Error{
        ErrorCode::invalidLight,
        "one of the light's u and v is zero; give two non-zero vectors, or two zero ones for a point"};
  }
  return light;
}

Result<AreaLight> areaLightAimed(glm::dvec3 centerWorld, glm::dvec3 targetWorld, double sizeU, double sizeV,
                                 glm::dvec3 up) {
  if (!isPlace(centerWorld) || !isPlace(targetWorld) || !isPlace(up) || !isPlace({sizeU, sizeV, 0.0}))
    return notAPlace();
  if (sizeU < 0.0 || sizeV < 0.0) {
    return Error{ErrorCode::invalidLight, "the light's size is negative; give full side lengths >= 0"};
  }
  if ((sizeU == 0.0) != (sizeV == 0.0)) {
    return Error{ErrorCode::invalidLight,
                 "one side of the light is zero, a line has no side to shine to; give two positive lengths, "
                 "or 0x0 for a point"};
  }
  const glm::dvec3 aim = targetWorld - centerWorld;
  if (glm::length(aim) == 0.0) {
    return Error{ErrorCode::invalidLight, "the light's target equals its centre; move one of them"};
  }
  const glm::dvec3 n = glm::normalize(aim);
  glm::dvec3 side = glm::cross(up, n);
  if (glm::length(side) <= 1e-9 * glm::length(up) || glm::length(up) == 0.0)
    side = glm::cross(leastAlignedAxis(n), n);
  const glm::dvec3 u = glm::normalize(side);
  const glm::dvec3 v = glm::cross(n, u);
  Result<AreaLight> light = areaLightFromVectors(centerWorld, u * (sizeU / 2), v * (sizeV / 2));
  if (!light) return light;
  light->emission = n;
  light->referenceDistance = glm::length(aim);
  return light;
}

glm::dvec3 emissionDirection(const AreaLight& light) {
  return light.emission;
}

}  // namespace halfshadow::scene
