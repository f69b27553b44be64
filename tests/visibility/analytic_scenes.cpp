// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "analytic_scenes.hpp"

#include <cmath>

#include "planner/light_fit.hpp"
#include "reference/closed_forms.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::test {
namespace {
constexpr double kCameraHeight = 20.0;
constexpr double kWallHeight = 1.0, kWallHalfWidth = 0.8;
const glm::dvec3 kWallLightCenter(-8.0, 8.0, 0.0);

scene::Camera wallCamera() {
  return cameraAbove(0.06, 0.0, 0.09);
}
}  // namespace

scene::SceneObject boxObject(const glm::dvec3& center, const glm::dvec3& half) {
  scene::SceneObject object = scenes::casterOf("box", scenes::boxShape(center, half));
  object.receives = false;
  return object;
}

scene::SceneObject groundPlane(double half) {
  scene::SceneObject object = scenes::casterOf("ground", scenes::planeShape(glm::dvec3(0.0), 2.0 * half));
  object.casts = false;
  return object;
}

scene::AreaLight lightAbove(const glm::dvec3& center, double halfU, double halfV, double turnRadians) {
  const double c = std::cos(turnRadians), s = std::sin(turnRadians);
  // x × z = -y: emits downwards.
  auto light = scene::areaLightFromVectors(center, halfU * glm::dvec3(c, 0, s), halfV * glm::dvec3(-s, 0, c));
  EXPECT_TRUE(light) << light.error().message;
  light->emission = {0, -1, 0};
  return *light;
}

scene::Camera cameraAbove(double x, double z, double halfHeight) {
  return {.eyeWorld = {x, kCameraHeight, z},
          .targetWorld = {x, 0.0, z},
          .up = {0, 0, -1},
          .verticalFovRadians = 2.0 * std::atan(halfHeight / kCameraHeight),
          .nearDistance = 0.5 * kCameraHeight,
          .farDistance = 1.5 * kCameraHeight};
}

glm::dvec3 groundPoint(const scene::Camera& camera, int width, int height, int x, int y) {
  const glm::dvec3 ray = scene::pixelRayWorld(camera, width, height, x, y);
  return camera.eyeWorld - ray * (camera.eyeWorld.y / ray.y);
}

scene::AreaLight PlateOverGround::light() const {
  return lightAbove({0, lightHeight, 0}, lightHalf, lightHalf);
}

scene::SceneDescription PlateOverGround::scene() const {
  scene::SceneDescription description{.name = "plate"};
  // Thin, so that its sides shadow nothing that its upper face does not: .002 over a height of 3.
  constexpr double kHalfThickness = 0.001;
  description.objects = {boxObject({0, plateHeight, 0}, {plateHalf, kHalfThickness, plateHalf}),
                         groundPlane(20.0)};
  description.camera = camera();
  description.lights = {light()};
  return description;
}

double PlateOverGround::visibility(const glm::dvec3& groundWorld) const {
  return reference::rectangleVisibility(light(), groundWorld, {0, plateHeight, 0}, plateHalf, plateHalf);
}

std::vector<float> PlateOverGround::visibilityImage() const {
  std::vector<float> image;
  const scene::Camera view = camera();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      image.push_back(static_cast<float>(visibility(groundPoint(view, kWidth, kHeight, x, y))));
  }
  return image;
}

double PlateOverGround::umbraHalf() const {
  return (plateHalf * lightHeight - lightHalf * plateHeight) / (lightHeight - plateHeight);
}
double PlateOverGround::litHalf() const {
  return (plateHalf * lightHeight + lightHalf * plateHeight) / (lightHeight - plateHeight);
}
double PlateOverGround::pixelWorld() const {
  const scene::Camera view = camera();
  return groundPoint(view, kWidth, kHeight, 1, 0).x - groundPoint(view, kWidth, kHeight, 0, 0).x;
}

scene::SceneDescription StandingWall::scene() const {
  scene::SceneDescription description{.name = "wall"};
  description.objects = {
      boxObject({0, 0.5 * kWallHeight, 0}, {halfThickness, 0.5 * kWallHeight, kWallHalfWidth}),
      groundPlane(20.0)};
  description.camera = wallCamera();
  auto light = scene::areaLightAimed(kWallLightCenter, {0, 0, 0}, 0.0, 0.0, {0, 0, 1});
  EXPECT_TRUE(light) << light.error().message;
  description.lights = {*light};
  return description;
}

double StandingWall::texelWorld() const {
  const scene::SceneDescription description = scene();
  std::vector<glm::dvec3> points;
  for (const glm::vec3& position : description.objects.front().mesh->positions) points.emplace_back(position);
  const planner::LightFit fit = planner::fitLight(description.lights.front(), points, {.mapSize = kMapSize});
  const glm::dvec2 perTangent = fit.texelsPerTangent();
  // Both axes may lie along the light's direction on the ground; the larger texel is meant. At 45 degrees the
  // ground stretches it by the square root of 2.
  return glm::length(kWallLightCenter) / std::min(perTangent.x, perTangent.y) * std::sqrt(2.0);
}

double StandingWall::pixelWorld() const {
  const scene::Camera view = wallCamera();
  return groundPoint(view, kWidth, kHeight, 1, 0).x - groundPoint(view, kWidth, kHeight, 0, 0).x;
}

double StandingWall::gapWorld(const Image& image) const {
  const scene::Camera view = wallCamera();
  const int row = image.height / 2;
  for (int x = 0; x < image.width; ++x) {
    const double at = groundPoint(view, image.width, image.height, x, row).x;
    if (at < halfThickness) continue;
    if (image.byte(static_cast<std::size_t>(row * image.width + x)) < 128) return at - halfThickness;
  }
  return 1e9;
}

}  // namespace halfshadow::test
