// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cassert>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "scenes/leaf_plates.hpp"
#include "scenes/scene_makers.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::scenes {
namespace {
using scene::SceneDescription;

void addCaster(SceneDescription& description, const Shape& shape) {
  description.objects.push_back(casterOf("caster" + std::to_string(description.objects.size()), shape));
}

SceneDescription finished(SceneDescription description, double lightHalfSize) {
  description.objects.push_back(groundObject());
  setBenchmarkView(description, lightHalfSize);
  return description;
}

/// Spheres of one radius at `origin` + spacing · (i, j, k), the indices from -half to half. They share a
/// mesh.
SceneDescription makeSpheres(double lightHalfSize, double radius, double spacing, double height,
                             const glm::ivec3& half) {
  SceneDescription description;
  const auto mesh = meshOf(uvSphereShape(radius));
  for (int i = -half.x; i <= half.x; ++i) {
    for (int j = -half.y; j <= half.y; ++j) {
      for (int k = -half.z; k <= half.z; ++k) {
        const glm::dvec3 center(spacing * i, height + spacing * j, spacing * k);
        description.objects.push_back({.name = "caster" + std::to_string(description.objects.size()),
                                       .mesh = mesh,
                                       .worldFromObject = glm::translate(glm::dmat4(1.0), center)});
      }
    }
  }
  return finished(std::move(description), lightHalfSize);
}
}  // namespace

void setView(SceneDescription& description, const glm::dvec3& eye, const glm::dvec3& target,
             const glm::dvec3& lightCenter, const glm::dvec3& lightTarget, double lightHalfSize) {
  description.camera =
      scene::Camera{.eyeWorld = eye, .targetWorld = target, .verticalFovRadians = glm::radians(34.0)};
  const Result<scene::AreaLight> light =
      scene::areaLightAimed(lightCenter, lightTarget, 2 * lightHalfSize, 2 * lightHalfSize, {0.2, 0.1, 1.0});
  assert(light.ok());  // constants, and lightHalfSize was checked by makeBuiltinScene
  description.lights = {light.value()};
}

void setBenchmarkView(SceneDescription& description, double lightHalfSize) {
  setView(description, {-6.5, 9, 1.5}, {-0.7, 0, -0.4}, {3, 12, 2}, {0, 1, 0}, lightHalfSize);
}

SceneDescription makeBox(double lightHalfSize) {
  const glm::dvec3 x = glm::normalize(glm::dvec3(1, 0.2, 0.3));
  const glm::dvec3 y = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), x));
  SceneDescription description;
  addCaster(description, boxShape({0, 1.8, 0}, {1.1, 0.35, 0.8}, x, y));
  return finished(std::move(description), lightHalfSize);
}

SceneDescription makeBars(double lightHalfSize) {
  SceneDescription description;
  addCaster(description, boxShape({0, 1.2, 0}, {2.2, 0.15, 0.22}));
  addCaster(description, boxShape({0.4, 2.8, 0.2}, {0.22, 0.15, 2.2}));
  return finished(std::move(description), lightHalfSize);
}

SceneDescription makeFence(double lightHalfSize) {
  SceneDescription description;
  for (int i = 0; i < 17; ++i) addCaster(description, boxShape({-2.4 + 0.3 * i, 0.9, 0}, {0.07, 0.85, 0.03}));
  for (const double y : {0.5, 1.3}) addCaster(description, boxShape({0, y, 0.08}, {2.6, 0.06, 0.03}));
  return finished(std::move(description), lightHalfSize);
}

SceneDescription makeLeaves(double lightHalfSize) {
  SceneDescription description;
  for (const LeafPlate& plate : kLeafPlates) {
    addCaster(description, boxShape(plate.centerWorld, {0.28, 0.012, 0.12}, plate.xAxis, plate.yAxis));
  }
  return finished(std::move(description), lightHalfSize);
}

SceneDescription makeFigure(double lightHalfSize) {
  struct Capsule {
    glm::dvec3 a, b;
    double radius;
  };
  const Capsule capsules[] = {
      {{-.18, .12, 0}, {-.22, 1, 0}, .12},    {{.18, .12, .15}, {.22, 1, 0}, .12},
      {{-.22, 1, 0}, {-.17, 1.75, 0}, .15},   {{.22, 1, 0}, {.17, 1.75, 0}, .15},
      {{0, 1.75, 0}, {0, 2.5, 0}, .28},       {{-.4, 2.55, 0}, {-.85, 1.9, .2}, .1},
      {{-.85, 1.9, .2}, {-.8, 1.3, .5}, .08}, {{.4, 2.55, 0}, {.95, 2.5, .1}, .1},
      {{.95, 2.5, .1}, {1.3, 3, .2}, .08},    {{0, 2.95, 0}, {0, 3.15, 0}, .22},
      {{-.4, 2.55, 0}, {.4, 2.55, 0}, .13},
  };
  SceneDescription description;
  for (const Capsule& capsule : capsules)
    addCaster(description, capsuleShape(capsule.a, capsule.b, capsule.radius));
  description.objects.push_back(groundObject());
  setView(description, {-6.5, 9, 1.5}, {-1, 0, -0.6}, {5, 9, 3}, {0, 1, 0}, lightHalfSize);
  return description;
}

SceneDescription makeSpheres27(double lightHalfSize) {
  return makeSpheres(lightHalfSize, 0.42, 1.1, 2, {1, 1, 1});
}

SceneDescription makeSpheres81(double lightHalfSize) {
  return makeSpheres(lightHalfSize, 0.27, 0.62, 2, {4, 0, 4});
}

SceneDescription makeSpheresCube(double lightHalfSize) {
  return makeSpheres(lightHalfSize, 0.27, 0.62, 3.5, {4, 4, 4});
}

}  // namespace halfshadow::scenes
