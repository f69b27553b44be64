// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/fitted_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfshadow::scenes {
namespace {
constexpr double kFovRadians = 34.0 * 3.14159265358979323846 / 180.0;
constexpr double kMargin = 1.05;
/// Of one object: more tell nothing more of its extent.
constexpr std::size_t kMostPoints = 20000;
}  // namespace

std::vector<glm::dvec3> castersAndShadows(const scene::SceneDescription& description,
                                          const std::vector<char>& isSubject, const scene::Bounds& subject,
                                          const scene::AreaLight& light) {
  std::vector<glm::dvec3> points;
  const auto add = [&](const glm::dvec3& point) {
    points.push_back(point);
    const double drop = light.centerWorld.y - point.y;
    if (!(drop > 0.0)) return;
    const double stretch = (light.centerWorld.y - subject.low.y) / drop;
    // A light near the horizon casts endless shadows; a radius of one is enough to look at.
    const glm::dvec3 offset = (point - light.centerWorld) * (stretch - 1.0);
    const double limit = subject.radius(), length = glm::length(offset);
    points.push_back(point + (length > limit ? offset * (limit / length) : offset));
  };
  for (std::size_t o = 0; o < description.objects.size(); ++o) {
    if (!isSubject[o]) continue;
    const scene::SceneObject& object = description.objects[o];
    const std::vector<std::uint32_t>& indices = object.mesh->indices;
    const std::size_t step = 1 + indices.size() / kMostPoints;
    for (std::size_t i = 0; i < indices.size(); i += step) {
      const glm::dvec3 position(object.mesh->positions[indices[i]]);
      add(glm::dvec3(object.worldFromObject * glm::dvec4(position, 1.0)));
    }
  }
  if (points.empty()) {
    for (const glm::dvec3& corner : subject.corners()) add(corner);
  }
  return points;
}

scene::Camera cameraFittedTo(const std::vector<glm::dvec3>& points) {
  scene::Camera camera{.verticalFovRadians = kFovRadians};
  const glm::dvec3 forward = glm::normalize(glm::dvec3(0.5, -0.6, -0.75));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double tanY = std::tan(kFovRadians / 2) / kMargin, tanX = tanY * 4 / 3;
  // A point x right, y up, z ahead is in view of an eye there where |x - eye.x| <= tan (z - eye.z): of each
  // side, the most demanding point.
  constexpr double kLeast = -std::numeric_limits<double>::infinity();
  double highX = kLeast, lowX = kLeast, highY = kLeast, lowY = kLeast, nearest = -kLeast;
  for (const glm::dvec3& point : points) {
    const double x = glm::dot(point, right), y = glm::dot(point, up), z = glm::dot(point, forward);
    highX = std::max(highX, x - tanX * z), lowX = std::max(lowX, -x - tanX * z);
    highY = std::max(highY, y - tanY * z), lowY = std::max(lowY, -y - tanY * z);
    nearest = std::min(nearest, z);
  }
  const double eyeZ = std::min(-(highX + lowX) / (2 * tanX), -(highY + lowY) / (2 * tanY));
  const double eyeX = (highX - lowX) / 2, eyeY = (highY - lowY) / 2;
  camera.eyeWorld = eyeX * right + eyeY * up + eyeZ * forward;
  const double reach = std::max(nearest - eyeZ, 1e-30);
  camera.targetWorld = camera.eyeWorld + forward * (2.0 * reach);
  return camera;
}

}  // namespace halfshadow::scenes
