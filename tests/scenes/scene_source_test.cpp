// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/scene_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "gltf_writer.hpp"

namespace halfshadow::scenes {
namespace {
using testing::GltfWriter;
using testing::Json;
using testing::quadWriter;

std::string quadFile(const GltfWriter& writer) {
  return GltfWriter::writeFile("scene.glb", writer.glb());
}

scene::SceneDescription opened(const std::string& source, const SceneOptions& options = {}) {
  auto result = openScene(source, options);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return result.ok() ? *result : scene::SceneDescription{};
}

const scene::SceneObject* groundOf(const scene::SceneDescription& description) {
  const auto found =
      std::find_if(description.objects.begin(), description.objects.end(),
                   [](const auto& object) { return object.name == "ground" && !object.casts; });
  return found == description.objects.end() ? nullptr : &*found;
}

TEST(SceneSource, FillsInGroundLightAndCamera) {
  const scene::SceneDescription description = opened(quadFile(quadWriter()));
  // The unit square: centre (.5, .5, 0), radius √½.
  const double radius = std::sqrt(0.5);
  const scene::SceneObject* ground = groundOf(description);
  ASSERT_NE(ground, nullptr);
  EXPECT_TRUE(ground->receives);
  EXPECT_NEAR(ground->worldFromObject[3].y, 0.0, 1e-12) << "at the lowest point";
  ASSERT_EQ(description.lights.size(), 1u);
  const scene::AreaLight& light = description.lights[0];
  EXPECT_NEAR(glm::length(light.centerWorld - glm::dvec3(.5, .5, 0)), 3 * radius, 1e-9);
  EXPECT_GT(light.centerWorld.y, 2 * radius) << "mostly above";
  EXPECT_NEAR(glm::length(light.halfU), 0.3 * radius, 1e-9);
  ASSERT_TRUE(description.camera.has_value());
  EXPECT_TRUE(scene::checkCamera(*description.camera).ok());
  EXPECT_EQ(description.notes.size(), 3u) << "one sentence for each addition";
}

TEST(SceneSource, KeepsAFloorAndObeysTheGroundMode) {
  GltfWriter writer = quadWriter();
  const int floor =
      writer.addAccessor(std::vector<float>{-9, -1, -9, -9, -1, 9, 9, -1, -9}, testing::kFloat, "VEC3", 3);
  writer.json["meshes"].push_back({{"primitives", Json::array({{{"attributes", {{"POSITION", floor}}}}})}});
  writer.json["nodes"].push_back({{"mesh", 1}, {"name", "tiles"}});
  writer.json["scenes"][0]["nodes"] = {0, 1};
  const std::string path = quadFile(writer);
  EXPECT_EQ(groundOf(opened(path)), nullptr) << "tiles are a floor";
  EXPECT_NE(groundOf(opened(path, {.ground = GroundMode::on})), nullptr);
  EXPECT_EQ(groundOf(opened("builtin:box", {.ground = GroundMode::off})), nullptr);
  EXPECT_EQ(opened("builtin:box").objects.size(), 2u) << "no second ground";
  EXPECT_EQ(opened("builtin:box", {.ground = GroundMode::on}).objects.size(), 2u);
}

TEST(SceneSource, OverridesReplaceTheScenesOwn) {
  scene::Camera camera{.eyeWorld = {0, 3, 10}, .targetWorld = {0, 1, 0}};
  const scene::AreaLight light{.centerWorld = {0, 9, 0}};
  const scene::SceneDescription description = opened("builtin:box", {.camera = camera, .light = light});
  EXPECT_EQ(description.camera->eyeWorld, camera.eyeWorld);
  ASSERT_EQ(description.lights.size(), 1u);
  EXPECT_EQ(description.lights[0].centerWorld, light.centerWorld);
}

TEST(SceneSource, NearAndFarEncloseWhatCanBeSeen) {
  for (const char* source :
       {"builtin:box", "builtin:tiny", "builtin:large-world", "builtin:room", "builtin:mannequin"}) {
    const scene::SceneDescription description = opened(source);
    const scene::Camera& camera = *description.camera;
    EXPECT_TRUE(scene::checkCamera(camera).ok());
    const glm::dmat4 view = scene::viewFromWorld(camera);
    const double tangentY = std::tan(camera.verticalFovRadians / 2), tangentX = tangentY * 4 / 3;
    for (const scene::SceneObject& object : description.objects) {
      if (!object.casts) continue;
      for (const std::uint32_t index : object.mesh->indices) {
        const glm::dvec4 p =
            view * object.worldFromObject * glm::dvec4(glm::dvec3(object.mesh->positions[index]), 1.0);
        const double depth = -p.z;
        if (depth <= 0 || std::abs(p.x) > depth * tangentX || std::abs(p.y) > depth * tangentY) continue;
        ASSERT_GE(depth, camera.nearDistance) << source << ", " << object.name;
        ASSERT_LE(depth, camera.farDistance) << source << ", " << object.name;
      }
    }
  }
}

TEST(SceneSource, ACameraInsideTheSceneStillHasANearPlane) {
  const scene::Camera inside{.eyeWorld = {0, 1.8, 0}, .targetWorld = {1, 1.8, 0}};
  const scene::SceneDescription description = opened("builtin:box", {.camera = inside});
  EXPECT_GT(description.camera->nearDistance, 0.0);
  EXPECT_LT(description.camera->nearDistance, 0.1) << "0.35 is the box's nearest wall";
}

TEST(SceneSource, ReportsWhatCannotBeOpened) {
  const auto unknown = openScene("builtin:nothing", {});
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::invalidArgument);
  const auto missing = openScene("nowhere.glb", {});
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::fileNotFound);
  EXPECT_NE(missing.error().message.find("nowhere.glb"), std::string::npos);
  const scene::Camera broken{.eyeWorld = {1, 1, 1}, .targetWorld = {1, 1, 1}};
  const auto camera = openScene("builtin:box", {.camera = broken});
  ASSERT_FALSE(camera.ok());
  EXPECT_EQ(camera.error().code, ErrorCode::invalidCamera);
}

}  // namespace
}  // namespace halfshadow::scenes
