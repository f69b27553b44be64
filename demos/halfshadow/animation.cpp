// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "animation.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "scenes/gltf_loader.hpp"

namespace halfshadow::cli {
namespace {
constexpr double kCircleRadiusPerDistance = 0.05;

/// `vector` turned about the unit `axis` by `angle` radians.
glm::dvec3 turned(const glm::dvec3& vector, const glm::dvec3& axis, double angle) {
  return vector * std::cos(angle) + glm::cross(axis, vector) * std::sin(angle) +
         axis * (glm::dot(axis, vector) * (1.0 - std::cos(angle)));
}

void moveLight(scene::SceneDescription& scene, double angle) {
  scene::AreaLight& light = scene.lights.front();
  const glm::dvec3 aim = scene::emissionDirection(light);
  const glm::dvec3 helper = std::abs(aim.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, aim)), y = glm::cross(aim, x);
  const scene::Bounds bounds = scene::boundsWorld(scene, scene::ObjectFilter::casters);
  const glm::dvec3 target = bounds.empty() ? scene.camera->targetWorld : bounds.center();
  const double radius = kCircleRadiusPerDistance * glm::length(light.centerWorld - target);
  light.centerWorld += radius * ((std::cos(angle) - 1.0) * x + std::sin(angle) * y);
}

void moveCamera(scene::SceneDescription& scene, double angle) {
  scene::Camera& camera = *scene.camera;
  camera.eyeWorld =
      camera.targetWorld + turned(camera.eyeWorld - camera.targetWorld, glm::normalize(camera.up), angle);
  scenes::fitNearAndFar(camera, scene);
}
}  // namespace

Animation::Animation(SceneArguments arguments, scene::SceneDescription first, Motion motion, int frames,
                     double framesPerSecond)
    : arguments_(std::move(arguments)),
      first_(std::move(first)),
      motion_(motion),
      frames_(frames),
      framesPerSecond_(framesPerSecond) {}

Result<scene::SceneDescription> Animation::poseAt(int frame) const {
  const double seconds = arguments_.animationTimeSeconds + frame / framesPerSecond_;
  auto scene = scenes::loadGltf(
      arguments_.source, {.animationTimeSeconds = seconds, .animationIndex = arguments_.animationIndex});
  if (!scene) return scene;
  // Fitted again, the ground would bob with every step, and camera and light would sway.
  for (std::size_t i = scene->objects.size(); i < first_.objects.size(); ++i) {
    if (first_.objects[i].name == "ground" && !first_.objects[i].casts)
      scene->objects.push_back(first_.objects[i]);
  }
  if (!scene->camera) scene->camera = first_.camera;
  if (scene->lights.empty()) scene->lights = first_.lights;
  if (Status status = scenes::completeScene(*scene, sceneOptions(arguments_)); !status) return status.error();
  if (scene->lights.size() > static_cast<std::size_t>(kMaxLights)) scene->lights.resize(kMaxLights);
  return scene;
}

Result<scene::SceneDescription> Animation::sceneAt(int frame) const {
  if (frame == 0) return first_;
  if (motion_ == Motion::time) return poseAt(frame);
  scene::SceneDescription scene = first_;
  const double angle = 2.0 * std::numbers::pi * frame / frames_;
  if (motion_ == Motion::light) moveLight(scene, angle);
  if (motion_ == Motion::camera) moveCamera(scene, angle);
  return scene;
}

std::string framePath(const std::string& path, int frame) {
  const std::filesystem::path file(path);
  char number[16];
  std::snprintf(number, sizeof number, "_%04d", frame);
  return (file.parent_path() / (file.stem().string() + number + file.extension().string())).string();
}

}  // namespace halfshadow::cli
