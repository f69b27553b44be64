// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The copied command line says the view again, to the last bit.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "scenes/camera_light_options.hpp"
#include "scenes/view_command.hpp"
#include "viewer/view.hpp"

namespace halfshadow::viewer {
namespace {

glm::dvec3 randomVector(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-50.0, 50.0);
  return {any(random), any(random), any(random)};
}

TEST(CommandLine, CamerasAreReadBackAsTheyAre) {
  std::mt19937 random(11);
  for (int i = 0; i < 500; ++i) {
    scene::Camera camera{.eyeWorld = randomVector(random),
                         .targetWorld = randomVector(random),
                         .up = randomVector(random),
                         .verticalFovRadians = 0.01 + 0.002 * i};
    const auto read = scenes::parseCamera(scenes::cameraText(camera));
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->eyeWorld, camera.eyeWorld);
    EXPECT_EQ(read->targetWorld, camera.targetWorld);
    EXPECT_EQ(read->up, camera.up);
    EXPECT_NEAR(read->verticalFovRadians, camera.verticalFovRadians, 1e-15) << i;
  }
}

TEST(CommandLine, LightsAreReadBackAsTheyAre) {
  std::mt19937 random(12);
  for (int i = 0; i < 500; ++i) {
    auto light =
        scene::areaLightFromVectors(randomVector(random), randomVector(random), randomVector(random));
    ASSERT_TRUE(light.ok());
    light->color = glm::vec3(0.1f * static_cast<float>(i % 7), 0.5f, 1.7f);
    light->intensity = 0.3 * i, light->referenceDistance = 1.0 / (1 + i);
    const auto read = scenes::parseLight(scenes::lightText(*light));
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(*read, *light);
  }
}

TEST(CommandLine, PointsKeepTheirDirection) {
  auto light = scene::areaLightAimed({1, 5, 2}, {0.3, 0, -1}, 0, 0, {0, 1, 0});
  ASSERT_TRUE(light.ok());
  const auto read = scenes::parseLight(scenes::lightText(*light));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_LT(glm::distance(scene::emissionDirection(*read), scene::emissionDirection(*light)), 1e-15);
  EXPECT_EQ(read->referenceDistance, light->referenceDistance);
}

TEST(CommandLine, AnEmissionOnlyFitsAPoint) {
  EXPECT_FALSE(scenes::parseLight("center=0,5,0 u=1,0,0 v=0,0,1 emission=0,-1,0").ok());
  EXPECT_FALSE(scenes::parseLight("center=0,5,0 u=0,0,0 v=0,0,0 emission=0,0,0").ok());
  EXPECT_FALSE(scenes::parseLight("center=0,5,0 target=0,0,0 size=1x1 emission=0,-1,0").ok());
  EXPECT_FALSE(scenes::parseLight("center=0,5,0 target=0,0,0 size=1x1 intensity=-1").ok());
  EXPECT_FALSE(scenes::parseLight("center=0,5,0 target=0,0,0 size=1x1 color=1,2").ok());
}

TEST(CommandLine, SaysAllOfTheView) {
  View view;
  view.source = "builtin:box";
  ASSERT_TRUE(openScene(view, Keep::nothing).ok());
  view.source = "my model's.glb";
  view.lights.push_back(view.lights.front());
  view.technique = "pcf";
  view.choices = {{"pcf.size", "7"}};
  view.forcedOff = {"depth-texture"};
  view.animationSeconds = 0.25;
  view.width = 320, view.height = 200;
  const std::string text = commandLine(view, "halfshadow render", "-o picture.png");
  EXPECT_NE(text.find("'my model'\\''s.glb'"), std::string::npos) << text;
  for (const char* part : {"-t pcf", "--set pcf.size=7", "--force depth-texture=off", "--animation-time 0.25",
                           "--size 320x200", "-o picture.png", "--ground"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is missing in " << text;
  }
  const std::size_t first = text.find("--light");
  EXPECT_NE(text.find("--light", first + 1), std::string::npos) << "both lights: " << text;
}

TEST(Scenes, AFailedOpenLeavesTheView) {
  View view;
  view.source = "builtin:box";
  ASSERT_TRUE(openScene(view, Keep::nothing).ok());
  const auto before = view.scene;
  view.source = "no such file.glb";
  const Status status = openScene(view, Keep::nothing);
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(view.scene, before);
}

TEST(Scenes, OpenedAgainTheyKeepCameraAndLights) {
  View view;
  view.source = "builtin:figure";
  ASSERT_TRUE(openScene(view, Keep::nothing).ok());
  view.camera.eyeWorld += glm::dvec3(0.5, 0.25, 0);
  view.lights.front().centerWorld.x += 1.0;
  view.lights.push_back(view.lights.front());
  const View before = view;
  ASSERT_TRUE(openScene(view, Keep::cameraAndLights).ok());
  EXPECT_EQ(view.camera.eyeWorld, before.camera.eyeWorld);
  EXPECT_EQ(view.lights, before.lights);
  EXPECT_EQ(view.scene->objects.size(), before.scene->objects.size());
}

}  // namespace
}  // namespace halfshadow::viewer
