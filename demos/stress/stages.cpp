// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "stress/stages.hpp"

#include <cassert>
#include <cstdio>
#include <utility>

#include "scenes/scene_source.hpp"

namespace halfshadow::stress {

SceneDescription builtin(const std::string& name) {
  auto scene = scenes::openScene("builtin:" + name, {});
  assert(scene.ok());  // names are constants of this folder
  return scene ? std::move(scene).value() : SceneDescription{};
}

SceneDescription withLight(SceneDescription scene, double halfU, double halfV) {
  scene::AreaLight& light = scene.lights.front();
  light.emission = scene::emissionDirection(light);
  light.halfU = glm::normalize(light.halfU) * halfU;
  light.halfV = glm::normalize(light.halfV) * halfV;
  return scene;
}

scene::AreaLight lightDown(const glm::dvec3& center, double halfU, double halfV) {
  // u × v = -y.
  return {.centerWorld = center, .halfU = {halfU, 0, 0}, .halfV = {0, 0, halfV}};
}

SceneDescription stage(std::vector<scene::SceneObject> objects, const scene::AreaLight& light,
                       const glm::dvec3& eye, const glm::dvec3& target, double fovRadians) {
  SceneDescription scene;
  scene.objects = std::move(objects);
  scene.lights = {light};
  scene.camera = scene::Camera{.eyeWorld = eye, .targetWorld = target, .verticalFovRadians = fovRadians};
  scenes::fitNearAndFar(*scene.camera, scene);
  return scene;
}

scene::SceneObject boxObject(const std::string& name, const glm::dvec3& center, const glm::dvec3& half) {
  return scenes::casterOf(name, scenes::boxShape(center, half));
}

scene::SceneObject floorObject(double width) {
  scene::SceneObject floor = scenes::casterOf("ground", scenes::planeShape({0, 0, 0}, width));
  floor.casts = false;
  return floor;
}

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::vector<Variant> baseVariants(std::uint64_t) {
  std::vector<Variant> all;
  for (const char* name : {"box", "box-small-light", "bars", "figure", "leaves", "lamp", "tower", "apart"})
    all.push_back({name, baseScene(name)});
  return all;
}

}  // namespace halfshadow::stress
