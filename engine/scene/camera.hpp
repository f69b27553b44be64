// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Perspective cameras. Positions are double: matrices are made camera-relative before they become float.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "base/error.hpp"

namespace halfshadow::scene {

struct Camera {
  glm::dvec3 eyeWorld{0, 0, 5};
  glm::dvec3 targetWorld{0.0};
  glm::dvec3 up{0, 1, 0};
  double verticalFovRadians = 0.8;
  double nearDistance = 0.1;  ///< along the view axis, > 0
  double farDistance = 1000.0;
  /// What is nearer is not meant to be seen: of cameras that stand farther away than what they stand for.
  /// Read by who fits near and far to a scene.
  double leastNearDistance = 0.0;
};

/// invalidCamera when NaN, eye equals target, field of view outside (0, π), or near/far not 0 < near < far.
Status checkCamera(const Camera& camera);

/// View space: camera at the origin, x right, y up, looking along -z.
glm::dmat4 viewFromWorld(const Camera& camera);
/// OpenGL clip space, depth -1 … 1.
glm::dmat4 clipFromView(const Camera& camera, double aspectWidthOverHeight);

/// Where on the way from the eye to a place the camera begins to see; none where the place is too near.
/// `near` is not fitted yet.
std::optional<glm::dvec3> sightBegin(const Camera& camera, const glm::dvec3& placeWorld);

/// From the eye to the near plane's corners, world units.
double nearReach(const Camera& camera, double aspectWidthOverHeight);

/// Unit direction in world space through the centre of pixel (x, y) of a width × height image; row 0 on top.
glm::dvec3 pixelRayWorld(const Camera& camera, int width, int height, double x, double y);

}  // namespace halfshadow::scene
