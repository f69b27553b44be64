// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "scenes/gltf_loader.hpp"
#include "scenes/scene_source.hpp"
#include "scenes/validate.hpp"

namespace halfshadow::scenes {
namespace {

std::string modelPath(const char* name) {
  return std::string(HALFSHADOW_SHARED_DIR) + "/scenes/" + name;
}

class PublicModel : public ::testing::TestWithParam<const char*> {};

TEST_P(PublicModel, OpensCompletely) {
  const std::string path = modelPath(GetParam());
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  const auto opened = openScene(path, {});
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  ASSERT_TRUE(opened->camera.has_value());
  EXPECT_FALSE(opened->lights.empty());
  const ValidationReport report = validateScene(*opened);
  EXPECT_GT(report.triangles, 1000u);
  // The fitted camera must see all of the casters in a 4:3 image.
  const glm::dmat4 clipFromWorld =
      scene::clipFromView(*opened->camera, 4.0 / 3.0) * scene::viewFromWorld(*opened->camera);
  double widest = 0.0;  // of the image's half sides, from its centre
  for (const scene::SceneObject& object : opened->objects) {
    if (!object.casts) continue;
    for (const std::uint32_t index : object.mesh->indices) {
      const glm::dvec3 position(object.mesh->positions[index]);
      const glm::dvec4 clip = clipFromWorld * object.worldFromObject * glm::dvec4(position, 1.0);
      ASSERT_GT(clip.w, 0.0);
      widest = std::max({widest, std::abs(clip.x) / clip.w, std::abs(clip.y) / clip.w});
    }
  }
  // The floor of a scene may reach out of the image; terrain.glb's is a caster too.
  if (std::string(GetParam()) == "terrain.glb") return;
  EXPECT_LE(widest, 1.0);
  EXPECT_GT(widest, 0.7) << "and fill it";
}

INSTANTIATE_TEST_SUITE_P(Gltf, PublicModel,
                         ::testing::Values("CesiumMan.glb", "cat.glb", "low-poly-tree.glb", "terrain.glb"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name) c = c == '.' || c == '-' ? '_' : c;
                           return name;
                         });

TEST(PublicModels, CesiumManWalks) {
  const std::string path = modelPath("CesiumMan.glb");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  const auto first = loadGltf(path, {.animationTimeSeconds = 0.0}),
             second = loadGltf(path, {.animationTimeSeconds = 0.5});
  ASSERT_TRUE(first.ok() && second.ok());
  const scene::TriangleMesh &a = *first->objects.at(0).mesh, &b = *second->objects.at(0).mesh;
  ASSERT_EQ(a.positions.size(), b.positions.size());
  double farthest = 0.0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    farthest = std::max(farthest, static_cast<double>(glm::length(a.positions[i] - b.positions[i])));
  }
  // He is 1.5 units tall and strides: a foot moves by a good part of a unit, nothing flies off.
  EXPECT_GT(farthest, 0.2);
  EXPECT_LT(farthest, 1.5);
  const scene::Bounds bounds = scene::boundsWorld(*first, scene::ObjectFilter::all);
  EXPECT_NEAR(bounds.high.y - bounds.low.y, 1.5, 0.2) << "upright along y";
  EXPECT_NE(first->objects[0].material.baseColorImage, nullptr) << "his JPEG or PNG skin is decoded";
}

}  // namespace
}  // namespace halfshadow::scenes
