// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/camera_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace halfshadow::viewer {
namespace {
struct Axes {
  glm::dvec3 right, up, forward;
};

Axes axesOf(const scene::Camera& camera) {
  const glm::dmat4 view = scene::viewFromWorld(camera);
  return {{view[0][0], view[1][0], view[2][0]},
          {view[0][1], view[1][1], view[2][1]},
          -glm::dvec3(view[0][2], view[1][2], view[2][2])};
}

/// `vector` turned about the unit `axis`. Based on: Rodrigues' rotation formula.
glm::dvec3 turned(const glm::dvec3& vector, const glm::dvec3& axis, double angle) {
  return vector * std::cos(angle) + glm::cross(axis, vector) * std::sin(angle) +
         axis * (glm::dot(axis, vector) * (1.0 - std::cos(angle)));
}
}  // namespace

void orbit(scene::Camera& camera, const glm::dvec2& pixels, double height) {
  constexpr double kNearestToPole = 0.02;  // radians
  const glm::dvec3 pole = glm::normalize(camera.up);
  const glm::dvec3 right = axesOf(camera).right;
  glm::dvec3 arm = camera.eyeWorld - camera.targetWorld;
  const double perPixel = std::numbers::pi / height;
  const double fromPole = std::acos(std::clamp(glm::dot(glm::normalize(arm), pole), -1.0, 1.0));
  const double wanted =
      std::clamp(fromPole - pixels.y * perPixel, kNearestToPole, std::numbers::pi - kNearestToPole);
  arm = turned(arm, right, wanted - fromPole);
  arm = turned(arm, pole, -pixels.x * perPixel);
  camera.eyeWorld = camera.targetWorld + arm;
}

void pan(scene::Camera& camera, const glm::dvec2& pixels, double height) {
  const Axes axes = axesOf(camera);
  const double distance = glm::length(camera.targetWorld - camera.eyeWorld);
  const double perPixel = 2.0 * std::tan(camera.verticalFovRadians / 2) * distance / height;
  const glm::dvec3 shift = perPixel * (axes.up * pixels.y - axes.right * pixels.x);
  camera.eyeWorld += shift;
  camera.targetWorld += shift;
}

void zoom(scene::Camera& camera, double steps) {
  const double factor = std::pow(0.9, std::clamp(steps, -50.0, 50.0));
  camera.eyeWorld = camera.targetWorld + (camera.eyeWorld - camera.targetWorld) * factor;
}

void fly(scene::Camera& camera, const glm::dvec3& shares) {
  const Axes axes = axesOf(camera);
  const double distance = glm::length(camera.targetWorld - camera.eyeWorld);
  const glm::dvec3 shift = distance * (axes.right * shares.x + axes.up * shares.y + axes.forward * shares.z);
  camera.eyeWorld += shift;
  camera.targetWorld += shift;
}

}  // namespace halfshadow::viewer
