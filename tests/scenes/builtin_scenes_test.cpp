// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/builtin_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <numeric>

#include "scenes/gltf_loader.hpp"
#include "scenes/validate.hpp"

namespace halfshadow::scenes {
namespace {

scene::SceneDescription make(std::string_view name) {
  auto made = makeBuiltinScene(name);
  EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
  return made.ok() ? *made : scene::SceneDescription{};
}

glm::dvec3 worldCorner(const scene::SceneObject& object, std::size_t corner) {
  const glm::dvec3 local(object.mesh->positions[object.mesh->indices[corner]]);
  return glm::dvec3(object.worldFromObject * glm::dvec4(local, 1.0));
}

class EveryBuiltinScene : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryBuiltinScene, IsCompleteClosedAndWoundOutward) {
  const scene::SceneDescription description = make(GetParam());
  ASSERT_TRUE(description.camera.has_value());
  EXPECT_TRUE(scene::checkCamera(*description.camera).ok());
  ASSERT_EQ(description.lights.size(), 1u);
  const ValidationReport report = validateScene(description);
  ASSERT_GT(report.casters, 0u);
  for (const ObjectReport& object : report.objects) {
    EXPECT_EQ(object.nonManifoldEdges, 0u) << object.name;
    EXPECT_EQ(object.degenerateDropped + object.duplicateDropped, 0u) << object.name;
    if (GetParam() == "sheets" || object.name == "ground") continue;  // open by definition
    EXPECT_TRUE(object.closed) << object.name;
    EXPECT_GT(object.signedVolumeWorld, 0.0) << object.name;
  }
}

TEST_P(EveryBuiltinScene, IsTheSameEveryTime) {
  const scene::SceneDescription a = make(GetParam()), b = make(GetParam());
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    const scene::TriangleMesh &first = *a.objects[i].mesh, &second = *b.objects[i].mesh;
    ASSERT_EQ(first.positions.size(), second.positions.size());
    EXPECT_EQ(std::memcmp(first.positions.data(), second.positions.data(), first.positions.size() * 12), 0);
    EXPECT_EQ(first.indices, second.indices);
    EXPECT_EQ(a.objects[i].worldFromObject, b.objects[i].worldFromObject);
  }
}

std::vector<std::string> allNames() {
  std::vector<std::string> names;
  for (const BuiltinInfo& info : builtinScenes()) names.push_back(info.name);
  return names;
}

std::string testName(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(BuiltinScenes, EveryBuiltinScene, ::testing::ValuesIn(allNames()), testName);

class TruthScene : public ::testing::TestWithParam<const char*> {};

// 1e-4: the truth's definitions are rounded to floats of about 1e-7 relative size, and the leaves' frames to
// seven decimals; a wrong vertex, axis or diagonal is off by 0.01 or more.
constexpr double kSameUnits = 1e-4;

TEST_P(TruthScene, HasTheTrianglesOfTheIndependentFile) {
  const std::string path = std::string(HALFSHADOW_SHARED_DIR) + "/truth/" + GetParam() + ".glb";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  const auto truth = loadGltf(path, {});
  ASSERT_TRUE(truth.ok()) << truth.error().message;
  const scene::SceneDescription made = make(GetParam());
  ASSERT_EQ(made.objects.size(), truth->objects.size());
  for (std::size_t i = 0; i < made.objects.size(); ++i) {
    const scene::SceneObject &ours = made.objects[i], &theirs = truth->objects[i];
    EXPECT_EQ(ours.name, theirs.name);
    EXPECT_EQ(ours.casts, theirs.casts);
    ASSERT_EQ(ours.mesh->triangleCount(), theirs.mesh->triangleCount()) << ours.name;
    // Triangles in any order and starting at any corner: each of ours is among theirs.
    for (std::size_t t = 0; t < ours.mesh->indices.size(); t += 3) {
      const glm::dvec3 a = worldCorner(ours, t), b = worldCorner(ours, t + 1), c = worldCorner(ours, t + 2);
      bool found = false;
      for (std::size_t s = 0; s < theirs.mesh->indices.size() && !found; s += 3) {
        for (std::size_t k = 0; k < 3 && !found; ++k) {
          found = glm::length(worldCorner(theirs, s + k) - a) < kSameUnits &&
                  glm::length(worldCorner(theirs, s + (k + 1) % 3) - b) < kSameUnits &&
                  glm::length(worldCorner(theirs, s + (k + 2) % 3) - c) < kSameUnits;
        }
      }
      ASSERT_TRUE(found) << ours.name << ", triangle " << t / 3 << " is not in the truth";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BuiltinScenes, TruthScene,
                         ::testing::Values("box", "bars", "fence", "leaves", "figure", "spheres27",
                                           "spheres81"));

TEST(BuiltinScenes, HaveTheLightOfTheTruth) {
  // The numbers of truth/index.json for spheres27_h0.3 and figure_h1, nine digits.
  const scene::AreaLight small = make("spheres27@light=0.3").lights.front();
  EXPECT_LT(glm::length(small.centerWorld - glm::dvec3(3, 12, 2)), 1e-9);
  EXPECT_LT(glm::length(small.halfU - glm::dvec3(0.287492191, -0.0692110829, -0.0505773298)), 1e-7);
  EXPECT_LT(glm::length(small.halfV - glm::dvec3(0.0361035203, -0.0627787327, 0.29112775)), 1e-7);
  const scene::AreaLight figure = make("figure").lights.front();
  EXPECT_LT(glm::length(figure.halfU - glm::dvec3(0.861640437, -0.492365964, -0.123091491)), 1e-7);
  EXPECT_LT(glm::length(figure.halfV - glm::dvec3(-0.0497364731, -0.323287075, 0.944992989)), 1e-7);
}

TEST(BuiltinScenes, HaveTheStatedSizes) {
  EXPECT_EQ(make("fence").objects.size(), 20u);
  EXPECT_EQ(make("leaves").objects.size(), 71u);
  EXPECT_EQ(make("spheres-cube").objects.size(), 730u);
  EXPECT_EQ(make("spheres27").objects.front().mesh->triangleCount(), 762u);
  EXPECT_EQ(make("figure").objects.front().mesh->triangleCount(), 320u);
  const auto infos = builtinScenes();
  EXPECT_EQ(infos.front().name, "box");
  EXPECT_EQ(infos.front().triangleCount(), 14u);
}

TEST(BuiltinScenes, MannequinIsOneConnectedMeshOfMoreThan50000Vertices) {
  const scene::SceneDescription description = make("mannequin");
  const scene::TriangleMesh& mesh = *description.objects.front().mesh;
  EXPECT_GT(mesh.positions.size(), 50000u);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  std::vector<std::uint32_t> root(mesh.positions.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (int k = 1; k < 3; ++k) root[find(mesh.indices[i + k])] = find(mesh.indices[i]);
  }
  const std::uint32_t first = find(mesh.indices.front());
  for (const std::uint32_t index : mesh.indices) ASSERT_EQ(find(index), first);
  const scene::Bounds bounds = scene::boundsOf(mesh);
  EXPECT_NEAR(bounds.low.y, 0.0, 0.02) << "it stands on the floor";
  EXPECT_NEAR(bounds.high.y, 3.6, 0.1) << "1.8 m at two units per metre";
}

TEST(BuiltinScenes, ParametersMoveEverythingTogether) {
  const scene::SceneDescription figure = make("figure"), tiny = make("tiny"), far = make("large-world");
  const glm::dvec3 corner = worldCorner(figure.objects[3], 7);
  EXPECT_LT(glm::length(worldCorner(tiny.objects[3], 7) - corner * 1e-3), 1e-12);
  EXPECT_LT(glm::length(worldCorner(far.objects[3], 7) - corner - glm::dvec3(1e4, 0, 1e4)), 1e-9);
  EXPECT_LT(glm::length(tiny.lights[0].halfU - figure.lights[0].halfU * 1e-3), 1e-15);
  EXPECT_LT(glm::length(far.camera->eyeWorld - figure.camera->eyeWorld - glm::dvec3(1e4, 0, 1e4)), 1e-9);
  EXPECT_NEAR(tiny.camera->nearDistance, figure.camera->nearDistance * 1e-3, 1e-9);
  EXPECT_EQ(make("figure@light=0").lights[0].halfU, glm::dvec3(0.0));
  EXPECT_NEAR(glm::length(make("box@light=2,scale=3").lights[0].halfV), 6.0, 1e-12);
}

TEST(BuiltinScenes, RefusesWhatItDoesNotKnow) {
  for (const char* name : {"", "boxx", "box@", "box@light", "box@light=", "box@light=-1", "box@light=nan",
                           "box@light=1x", "box@scale=0", "box@color=1", "box@light=1,,scale=2"}) {
    const auto made = makeBuiltinScene(name);
    ASSERT_FALSE(made.ok()) << name;
    EXPECT_EQ(made.error().code, ErrorCode::invalidArgument) << name;
  }
  EXPECT_NE(makeBuiltinScene("boxx").error().message.find("spheres27"), std::string::npos)
      << "lists what exists";
}

}  // namespace
}  // namespace halfshadow::scenes
