// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/camera.hpp"

#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>

#include "scene/place.hpp"

namespace halfshadow::scene {
namespace {
struct Frame {
  glm::dvec3 right, up, forward;
};

Frame cameraFrame(const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(camera.targetWorld - camera.eyeWorld);
  glm::dvec3 side = glm::cross(forward, camera.up);
  if (glm::length(side) <= 1e-9 * glm::length(camera.up)) {
    side = glm::cross(forward, std::abs(forward.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{0, 0, -1});
  }
  const glm::dvec3 right = glm::normalize(side);
  return {right, glm::cross(right, forward), forward};
}
}  // namespace

Status checkCamera(const Camera& camera) {
  if (!isPlace(camera.eyeWorld) || !isPlace(camera.targetWorld) || !isPlace(camera.up) ||
      !isPlace({camera.nearDistance, camera.farDistance, 0.0})) {
    return Error{
        ErrorCode::invalidCamera,
        "the camera has a NaN or infinite component, or one beyond 1e30; give smaller, finite numbers"};
  }
  if (glm::length(camera.targetWorld - camera.eyeWorld) == 0.0 || glm::length(camera.up) == 0.0) {
    return Error{ErrorCode::invalidCamera,
                 "the camera's eye equals its target, or up is zero; move one of them"};
  }
  if (!(camera.verticalFovRadians > 0.0 && camera.verticalFovRadians < 3.14159)) {
    return Error{ErrorCode::invalidCamera, "the camera's field of view must lie between 0 and 180 degrees"};
  }
  if (!(camera.nearDistance > 0.0 && camera.farDistance > camera.nearDistance &&
        std::isfinite(camera.farDistance))) {
    return Error{ErrorCode::invalidCamera, "the camera needs 0 < near < far"};
  }
  return {};
}

glm::dmat4 viewFromWorld(const Camera& camera) {
  const Frame f = cameraFrame(camera);
  glm::dmat4 m(1.0);
  for (int column = 0; column < 3; ++column) {
    m[column][0] = f.right[column];
    m[column][1] = f.up[column];
    m[column][2] = -f.forward[column];
  }
  m[3] = glm::dvec4(-glm::dot(f.right, camera.eyeWorld), -glm::dot(f.up, camera.eyeWorld),
                    glm::dot(f.forward, camera.eyeWorld), 1.0);
  return m;
}

glm::dmat4 clipFromView(const Camera& camera, double aspectWidthOverHeight) {
  return glm::perspective(camera.verticalFovRadians, aspectWidthOverHeight, camera.nearDistance,
                          camera.farDistance);
}

std::optional<glm::dvec3> sightBegin(const Camera& camera, const glm::dvec3& placeWorld) {
  if (!(camera.leastNearDistance > 0.0)) return camera.eyeWorld;
  const glm::dvec3 way = placeWorld - camera.eyeWorld;
  const double depth = glm::dot(way, glm::normalize(camera.targetWorld - camera.eyeWorld));
  if (!(depth > camera.leastNearDistance)) return std::nullopt;
  return camera.eyeWorld + way * (camera.leastNearDistance / depth);
}

double nearReach(const Camera& camera, double aspectWidthOverHeight) {
  const double tangent = std::tan(0.5 * camera.verticalFovRadians);
  return camera.nearDistance *
         std::sqrt(1.0 + tangent * tangent * (1.0 + aspectWidthOverHeight * aspectWidthOverHeight));
}

glm::dvec3 pixelRayWorld(const Camera& camera, int width, int height, double x, double y) {
  const Frame f = cameraFrame(camera);
  const double tanHalf = std::tan(camera.verticalFovRadians / 2);
  const double sx = ((x + 0.5) / width * 2 - 1) * tanHalf * width / height;
  const double sy = (1 - (y + 0.5) / height * 2) * tanHalf;
  return glm::normalize(f.forward + sx * f.right + sy * f.up);
}

}  // namespace halfshadow::scene
