// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/light_space.hpp"

#include <cmath>

namespace halfshadow::planner {
namespace {

// Below this share of its length a vector's component is rounding noise.
constexpr double kParallel = 1e-9;

// The world axis least aligned with the direction; ties go to the first, so that the frame is stable.
glm::dvec3 leastAlignedAxis(const glm::dvec3& direction) {
  const glm::dvec3 size = glm::abs(direction);
  if (size.x <= size.y && size.x <= size.z) return {1, 0, 0};
  return size.y <= size.z ? glm::dvec3{0, 1, 0} : glm::dvec3{0, 0, 1};
}

// Unit direction of v without its part along the unit vector n; `fallback` when nothing is left.
glm::dvec3 perpendicular(const glm::dvec3& v, const glm::dvec3& n, const glm::dvec3& fallback) {
  const glm::dvec3 rest = v - n * glm::dot(v, n);
  const double length = glm::length(rest);
  return length > kParallel * glm::length(v) ? rest / length : fallback;
}

}  // namespace

glm::dmat4 LightSpace::matrix() const {
  glm::dmat4 m(1.0);
  for (int column = 0; column < 3; ++column) {
    m[column] = glm::dvec4(axisX[column], axisY[column], axisZ[column], 0.0);
  }
  m[3] = glm::dvec4(-glm::dot(axisX, originWorld), -glm::dot(axisY, originWorld),
                    -glm::dot(axisZ, originWorld), 1.0);
  return m;
}

scene::Bounds LightSpace::boundsLight(const scene::Bounds& boundsWorld) const {
  scene::Bounds bounds;
  if (boundsWorld.empty()) return bounds;
  for (const glm::dvec3& corner : boundsWorld.corners()) bounds.include(lightFromWorld(corner));
  return bounds;
}

LightSpace lightSpace(const scene::AreaLight& light) {
  LightSpace space;
  space.originWorld = light.centerWorld;
  const double lengthU = glm::length(light.halfU), lengthV = glm::length(light.halfV);
  glm::dvec3 z = glm::normalize(scene::emissionDirection(light));
  const glm::dvec3 normal = glm::cross(light.halfU, light.halfV);
  if (glm::length(normal) > kParallel * lengthU * lengthV) z = glm::normalize(normal);
  const glm::dvec3 arbitrary = glm::normalize(glm::cross(leastAlignedAxis(z), z));
  if (lengthU > 0.0) {
    space.axisX = perpendicular(light.halfU, z, arbitrary);
  } else if (lengthV > 0.0) {
    space.axisX = glm::cross(perpendicular(light.halfV, z, arbitrary), z);
  } else {
    space.axisX = arbitrary;
  }
  space.axisZ = z;
  space.axisY = glm::cross(z, space.axisX);
  space.halfSize = {
      std::abs(glm::dot(space.axisX, light.halfU)) + std::abs(glm::dot(space.axisX, light.halfV)),
      std::abs(glm::dot(space.axisY, light.halfU)) + std::abs(glm::dot(space.axisY, light.halfV))};
  return space;
}

std::array<glm::dvec3, 4> lightCornersRelative(const scene::AreaLight& light) {
  return {light.halfU + light.halfV, light.halfU - light.halfV, light.halfV - light.halfU,
          -light.halfU - light.halfV};
}

}  // namespace halfshadow::planner
