// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "reference/closed_forms.hpp"

#include <algorithm>

namespace halfshadow::reference {
namespace {

/// Central projection from the receiver onto the light's plane, in the light's own coordinates, in which the
/// light is the square [-1, 1]². Parallel planes: the projection is a scaling by `magnification`.
struct Projection {
  bool between = false;
  double magnification = 1.0;
  double a = 0.0, b = 0.0;
};

Projection projected(const scene::AreaLight& light, glm::dvec3 receiverWorld, glm::dvec3 pointWorld) {
  const glm::dvec3 normal = glm::cross(light.halfU, light.halfV);
  const double toLight = glm::dot(normal, light.centerWorld - receiverWorld);
  const double toPoint = glm::dot(normal, pointWorld - receiverWorld);
  Projection result;
  result.between = toPoint / toLight > 0.0 && toPoint / toLight < 1.0;
  if (!result.between) return result;
  result.magnification = toLight / toPoint;
  const glm::dvec3 offset =
      receiverWorld + result.magnification * (pointWorld - receiverWorld) - light.centerWorld;
  const double area = glm::dot(normal, normal);
  result.a = glm::dot(glm::cross(offset, light.halfV), normal) / area;
  result.b = glm::dot(glm::cross(light.halfU, offset), normal) / area;
  return result;
}

double coveredShare(double low, double high) {
  return std::max(0.0, std::min(high, 1.0) - std::max(low, -1.0)) / 2.0;
}

}  // namespace

double halfPlaneVisibility(const scene::AreaLight& light, glm::dvec3 receiverWorld,
                           glm::dvec3 edgePointWorld) {
  const Projection edge = projected(light, receiverWorld, edgePointWorld);
  return edge.between ? 1.0 - coveredShare(edge.a, 1.0) : 1.0;
}

double rectangleVisibility(const scene::AreaLight& light, glm::dvec3 receiverWorld, glm::dvec3 centerWorld,
                           double lengthU, double lengthV) {
  const Projection center = projected(light, receiverWorld, centerWorld);
  if (!center.between) return 1.0;
  const double extentA = center.magnification * lengthU / glm::length(light.halfU);
  const double extentB = center.magnification * lengthV / glm::length(light.halfV);
  return 1.0 - coveredShare(center.a - extentA, center.a + extentA) *
                   coveredShare(center.b - extentB, center.b + extentB);
}

}  // namespace halfshadow::reference
