// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What frames of wedges-cells cost, and odd lights and casters.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "reference/closed_forms.hpp"
#include "reference/reference.hpp"
#include "scenes/shapes.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

using CellsFrames = SharedEngineTest;
const Configuration kCells = {"wedges-cells"};

TEST_F(CellsFrames, OneFramebufferAndNoPassButTheReceivers) {
  renderer().load(builtinScene("spheres27@light=1"));
  renderer().render(kCells);
  EXPECT_EQ(renderer().report().passes.size(), 1u);
  EXPECT_EQ(renderer().report().framebufferSwitches, 1u);
  EXPECT_GT(renderer().report().textureBytesUploaded, 0u);
}

TEST_F(CellsFrames, ListsAreMadeOnceForAStandingScene) {
  const scene::SceneDescription& scene = builtinScene("figure@light=0.3");
  renderer().load(scene);
  const Image first = renderer().render(kCells);
  EXPECT_EQ(renderer().render().rgba, first.rgba);
  EXPECT_EQ(renderer().report().textureBytesUploaded, 0u);
  renderer().desc().camera.eye[0] += 0.5;
  renderer().render();
  EXPECT_EQ(renderer().report().textureBytesUploaded, 0u) << "lists do not depend on the camera";
  glm::dmat4 moved = scene.objects[9].worldFromObject;
  moved[3].x += 0.1;
  renderer().setTransform(9, moved);
  renderer().render();
  EXPECT_GT(renderer().report().textureBytesUploaded, 0u);
}

/// Largest difference to the closed form of a plate parallel to the light, whatever the light's proportions.
double plateError(double plateHalf, double halfU, double halfV, const Configuration& configuration,
                  SceneRenderer& renderer) {
  const double height = 3.0;
  const scene::AreaLight light = lightAbove({0, 12, 0}, halfU, halfV);
  scene::SceneDescription scene{.name = "plate"};
  scene.objects = {boxObject({0, height, 0}, {plateHalf, 0.001, plateHalf}), groundPlane(20.0)};
  scene.camera = cameraAbove(0.0, 0.0, 4.0);
  scene.lights = {light};
  renderer.load(scene);
  const std::vector<float> visibility = renderer.render(configuration).visibility();
  double worst = 0.0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double truth = reference::rectangleVisibility(
          light, groundPoint(*scene.camera, kWidth, kHeight, x, y), {0, height, 0}, plateHalf, plateHalf);
      // The plate itself hides the ground below it from the camera.
      const glm::dvec3 at = groundPoint(*scene.camera, kWidth, kHeight, x, y);
      const double seen = plateHalf * scene.camera->eyeWorld.y / (scene.camera->eyeWorld.y - height) * 1.05;
      if (std::max(std::abs(at.x), std::abs(at.z)) < seen) continue;
      worst = std::max(worst, std::abs(visibility[static_cast<std::size_t>(y * kWidth + x)] - truth));
    }
  }
  return worst;
}

TEST_F(CellsFrames, PlatesFollowTheClosedFormForLightsOfAnyProportion) {
  // A plate parallel to the light casts the same silhouette for all of it: 8-bit storage, fp32 areas and the
  // 16-bit places of vertices are what is left. Without highp a fragment's place has 11 bits: of the 12 units
  // to the light, a hundredth of a unit, against penumbrae of .17 units for the narrowest side.
  const double bound = isForcedOff("highp") ? 0.1 : 0.01;
  for (const auto& [halfU, halfV] : {std::pair{1.0, 1.0}, std::pair{2.0, 0.25}, std::pair{0.25, 2.0}}) {
    for (const char* bytes : {"4", "16", "32"}) {
      EXPECT_LE(plateError(0.4, halfU, halfV, {"wedges-cells", {{"wedges-cells.bytes", bytes}}}, renderer()),
                bound)
          << halfU << " x " << halfV << ", " << bytes;
    }
  }
}

TEST_F(CellsFrames, PointLightCastsHardShadows) {
  const Truth& truth = truthOf("box@light=0");
  renderer().load(builtinScene("box@light=0"));
  const std::vector<float> hard = renderer().render(kCells).visibility();
  int differing = 0, shadowed = 0;
  for (std::size_t i = 0; i < hard.size(); ++i) {
    if (truth.kind[i] == reference::kNoReceiver) continue;
    differing += std::abs(hard[i] - truth.visibility[i]) > 0.25f;
    shadowed += truth.visibility[i] < 0.5f;
  }
  EXPECT_GT(shadowed, 500);
  // Pixels on the outline; without highp, those within its 11 bits of it.
  EXPECT_LE(differing, isForcedOff("highp") ? 150 : 5);
}

TEST_F(CellsFrames, EachLightHasItsChannel) {
  scene::SceneDescription scene = builtinScene("figure@light=0.3");
  scene::AreaLight second = scene.lights[0];
  second.centerWorld.x = -second.centerWorld.x;
  scene.lights = {second};
  renderer().load(scene);
  const Image alone = renderer().render(kCells);
  scene.lights = {builtinScene("figure@light=0.3").lights[0], second};
  renderer().load(scene);
  const Image both = renderer().render(kCells);
  int differing = 0;
  for (std::size_t i = 0; i < both.pixels(); ++i) differing += both.byte(i, 1) != alone.byte(i, 0);
  EXPECT_LE(differing, 20) << "pixels on outlines";
}

TEST_F(CellsFrames, LightInsideAClosedCasterLightsNothingOutside) {
  scene::SceneDescription scene{.name = "lamp"};
  scene.objects = {boxObject({0, 4, 0}, {1, 1, 1}), groundPlane(20.0)};
  scene.camera = cameraAbove(0.0, 0.0, 4.0);
  scene.lights = {lightAbove({0, 4, 0}, 0.2, 0.2)};
  renderer().load(scene);
  const Image image = renderer().render(kCells);
  // The corner shows the ground.
  EXPECT_EQ(image.byte(0), 0);
}

TEST_F(CellsFrames, CasterBehindTheLightCastsNothing) {
  scene::SceneDescription scene{.name = "above"};
  scene.objects = {boxObject({0, 9, 0}, {1, 1, 1}), groundPlane(20.0)};
  scene.camera = cameraAbove(0.0, 0.0, 4.0);
  scene.camera->eyeWorld.y = 6.0;
  scene.lights = {lightAbove({0, 7, 0}, 0.5, 0.5)};
  renderer().load(scene);
  const Image image = renderer().render(kCells);
  for (std::size_t i = 0; i < image.pixels(); ++i) ASSERT_EQ(image.byte(i), 255);
}

}  // namespace
}  // namespace halfshadow::test
