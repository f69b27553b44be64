// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/scene_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <memory>

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
  EXPECT_LT(description.camera->nearDistance, 0.6) << "the wall ahead";
}

/// One object a call: triangles of its own, casting and receiving.
class SceneOf {
 public:
  SceneOf& add(const std::vector<float>& positions, const std::vector<std::uint32_t>& indices,
               const glm::dvec3& place = glm::dvec3(0.0)) {
    const auto mesh = scene::buildMesh({.positions = positions.data(),
                                        .vertexCount = static_cast<std::uint32_t>(positions.size() / 3),
                                        .indices = indices.data(),
                                        .indexCount = indices.size()});
    EXPECT_TRUE(mesh.ok());
    description_.objects.push_back({.name = "object " + std::to_string(description_.objects.size()),
                                    .mesh = std::make_shared<const scene::TriangleMesh>(*mesh),
                                    .worldFromObject = glm::translate(glm::dmat4(1.0), place)});
    return *this;
  }
  SceneOf& addBox(const glm::vec3& low, const glm::vec3& high, const glm::dvec3& place = glm::dvec3(0.0)) {
    std::vector<float> positions;
    for (unsigned i = 0; i < 8; ++i) {
      positions.insert(positions.end(),
                       {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    }
    return add(positions, {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                           2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5},
               place);
  }
  SceneOf& addSheet(float half, float y) {
    return add({-half, y, -half, half, y, -half, -half, y, half, half, y, half}, {0, 1, 2, 1, 3, 2});
  }
  scene::SceneDescription completed(const SceneOptions& options = {}) {
    scene::SceneDescription copy = description_;
    const Status status = completeScene(copy, options);
    EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
    return copy;
  }

 private:
  scene::SceneDescription description_{.name = "test"};
};

scene::AreaLight lightAt(const glm::dvec3& center) {
  return *scene::areaLightAimed(center, {0, 0, 0}, 0.5, 0.5, {0.2, 0.1, 1.0});
}

TEST(AddedGround, NeverLiesInASurfaceThatIsSeen) {
  // A sheet alone, a tray with a rim, and a room seen from inside: each is its own floor.
  EXPECT_EQ(groundOf(SceneOf().addSheet(1, 0).completed()), nullptr);
  SceneOf tray;
  tray.add({-2, 0, -2, 2, 0, -2, -2, 0, 2, 2, 0, 2, -2, 1, -2, 2, 1, -2},
           {0, 2, 1, 1, 2, 3, 0, 1, 4, 1, 5, 4});
  EXPECT_EQ(groundOf(tray.completed()), nullptr);
  SceneOf room;
  room.addBox({-3, 0, -3}, {3, 3, 3}).addBox({-1, 0, -1}, {0, 1, 0});
  const scene::Camera inside{.eyeWorld = {2, 1.5, 2}, .targetWorld = {0, 0.5, 0}};
  EXPECT_EQ(groundOf(room.completed({.camera = inside, .light = lightAt({1, 2.5, 0})})), nullptr);
  // Asked for, it is there, but below the floor.
  const auto asked = tray.completed({.ground = GroundMode::on});
  ASSERT_NE(groundOf(asked), nullptr);
  EXPECT_LT(groundOf(asked)->worldFromObject[3].y, 0.0);
  // A small mat is no floor: the ground is a little below it.
  SceneOf mat;
  mat.addBox({-9, 0, -9}, {-7, 3, 9}).addSheet(2.0f, 0.0f);
  const auto withMat = mat.completed();
  ASSERT_NE(groundOf(withMat), nullptr);
  EXPECT_LT(groundOf(withMat)->worldFromObject[3].y, 0.0);
  EXPECT_GT(groundOf(withMat)->worldFromObject[3].y, -0.05);
  // The underside of what stands on it is not seen: there it touches.
  const auto standing = SceneOf().addBox({-1, 0, -1}, {1, 2, 1}).completed();
  ASSERT_NE(groundOf(standing), nullptr);
  EXPECT_EQ(groundOf(standing)->worldFromObject[3].y, 0.0);
}

TEST(AddedGround, NeverComesBetweenCameraOrLightAndTheScene) {
  SceneOf scene;
  scene.addBox({-1, -1, -1}, {1, 1, 1});
  for (const double below : {-1.0, -1.5, -20.0}) {
    const scene::Camera camera{.eyeWorld = {3, below, 4}, .targetWorld = {0, 0, 0}};
    const auto fromBelow = scene.completed({.camera = camera, .light = lightAt({1, 5, 1})});
    EXPECT_EQ(groundOf(fromBelow), nullptr) << below;
    EXPECT_FALSE(fromBelow.notes.empty()) << "and it is said why";
    EXPECT_EQ(groundOf(scene.completed({.light = lightAt({3, below, 4})})), nullptr) << below;
  }
  const scene::Camera above{.eyeWorld = {3, -0.9, 4}, .targetWorld = {0, 0, 0}};
  EXPECT_NE(groundOf(scene.completed({.camera = above, .light = lightAt({1, 5, 1})})), nullptr);
}

TEST(SceneSource, TheNearPlaneFollowsWhatIsSeenHoweverFarTheSceneGoes) {
  const scene::Camera camera{.eyeWorld = {0, 2, -3}, .targetWorld = {0, 0, 0}};
  double first = 0.0;
  for (const double far : {30.0, 1e3, 1e5, 1e7}) {
    SceneOf scene;
    scene.addBox({-1, 0, -1}, {1, 1, 1}).addBox({-1, 0, -1}, {1, 1, 1}, {0, 0, far});
    const auto completed =
        scene.completed({.ground = GroundMode::off, .camera = camera, .light = lightAt({1, 5, 1})});
    if (first == 0.0) first = completed.camera->nearDistance;
    EXPECT_NEAR(completed.camera->nearDistance, first, 1e-9 * far) << far;
    EXPECT_GT(completed.camera->farDistance, 0.85 * far) << "along the view";
  }
  EXPECT_GT(first, 1.0);
  EXPECT_LT(first, 2.5);
  // A sheet through the eye, seen edge-on, does not pull it there.
  SceneOf edgeOn;
  edgeOn.addBox({-1, 0, -1}, {1, 1, 1}).addSheet(1000.0f, 2.0f);
  const scene::Camera level{.eyeWorld = {0, 2, -5}, .targetWorld = {0, 2, 0}};
  EXPECT_GT(edgeOn.completed({.camera = level, .light = lightAt({1, 5, 1})}).camera->nearDistance, 0.01);
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
