// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "gltf_writer.hpp"
#include "scenes/builtin_scenes.hpp"

namespace halfshadow::scenes {
namespace {

bool anyContains(const std::vector<std::string>& sentences, std::string_view words) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& s) { return s.find(words) != std::string::npos; });
}

TEST(Validate, ACleanSceneHasNoWarnings) {
  const ValidationReport report = validateScene(*makeBuiltinScene("spheres27"));
  EXPECT_EQ(report.casters, 27u);
  EXPECT_EQ(report.openCasters, 0u);
  EXPECT_EQ(report.triangles, 27u * 762 + 2);
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_EQ(report.objects[0].weldedVertices, 383u);
  // 762 triangles inscribed in a sphere of radius 0.42 (volume 0.3103): a few per cent less.
  EXPECT_NEAR(report.objects[0].signedVolumeWorld, 0.3034, 0.001);
  EXPECT_TRUE(report.objects[0].warnings.empty());
}

TEST(Validate, NamesOpenCastersAndInsideOutOnes) {
  const ValidationReport sheets = validateScene(*makeBuiltinScene("sheets"));
  EXPECT_EQ(sheets.openCasters, 40u);
  EXPECT_TRUE(anyContains(sheets.objects[0].warnings, "open"));

  testing::GltfWriter writer;
  const int position =
      writer.addAccessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, testing::kFloat, "VEC3", 3);
  const int indices =
      writer.addAccessor(std::vector<std::uint8_t>{0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 1, 1, 2},
                         testing::kUnsignedByte, "SCALAR", 1);
  writer.addPrimitive({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  const auto loaded = writer.load();
  ASSERT_TRUE(loaded.ok());
  const ValidationReport report = validateScene(*loaded);
  EXPECT_TRUE(report.objects[0].warnings.empty() || !anyContains(report.objects[0].warnings, "inside out"))
      << "it is turned round, for drawing too";
  EXPECT_EQ(report.objects[0].turnedTriangles, 4u);
  EXPECT_GT(report.objects[0].signedVolumeWorld, 0.0);
  EXPECT_TRUE(anyContains(report.objects[0].repairs, "turned round"));
  EXPECT_EQ(report.objects[0].degenerateDropped, 1u);
}

TEST(Validate, TellsWhatWasMendedForSilhouettes) {
  // A tetrahedron whose base is two triangles that meet at the middle of an edge, one of them flipped, and a
  // fin on another edge.
  testing::GltfWriter writer;
  const int position = writer.addAccessor(
      std::vector<float>{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 1, 0, 0, -1, -1, 3}, testing::kFloat, "VEC3", 3);
  const int indices =
      writer.addAccessor(std::vector<std::uint8_t>{0, 2, 4, 4, 1, 2, 0, 1, 3, 0, 3, 2, 1, 2, 3, 0, 3, 5},
                         testing::kUnsignedByte, "SCALAR", 1);
  writer.addPrimitive({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  const auto loaded = writer.load();
  ASSERT_TRUE(loaded.ok());
  const ValidationReport report = validateScene(*loaded);
  const ObjectReport& object = report.objects[0];
  EXPECT_EQ(object.parts, 2u);
  EXPECT_EQ(object.sheets, 1u);
  EXPECT_EQ(object.looseParts, 1u);
  EXPECT_EQ(object.repairedTJunctions, 1u);
  EXPECT_EQ(object.flippedFaces, 1u);
  EXPECT_EQ(object.nonManifoldEdges, 1u);
  EXPECT_EQ(report.repairedCasters, 1u);
  EXPECT_EQ(report.openCasters, 1u);
  EXPECT_TRUE(anyContains(object.repairs, "T-junction"));
  EXPECT_TRUE(anyContains(object.repairs, "turned round"));
  EXPECT_TRUE(anyContains(object.warnings, "fins"));
}

TEST(Validate, SaysWhereSinglePrecisionDoesNotHoldTheShape) {
  // Size and place of a scene are no fault by themselves: transforms are in double.
  for (const char* name : {"box@scale=1e6", "box@scale=1e-6", "box@shift=1e7"}) {
    const ValidationReport report = validateScene(*makeBuiltinScene(name));
    EXPECT_TRUE(report.warnings.empty()) << name;
    EXPECT_TRUE(report.objects[0].warnings.empty()) << name;
  }
  // Baked into the vertices, a place costs digits: steps of 2^-4 at 1e6, of 2^-10 at 1e4.
  for (const auto& [away, isWarned] :
       {std::pair(1e4f, false), std::pair(1e5f, true), std::pair(1e6f, true)}) {
    testing::GltfWriter writer;
    const int position = writer.addAccessor(
        std::vector<float>{away, 0, 0, away + 1, 0, 0, away, 1, 0, away, 0, 1}, testing::kFloat, "VEC3", 3);
    const int indices = writer.addAccessor(std::vector<std::uint8_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3},
                                           testing::kUnsignedByte, "SCALAR", 1);
    writer.addPrimitive({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
    const auto loaded = writer.load();
    ASSERT_TRUE(loaded.ok());
    EXPECT_EQ(anyContains(validateScene(*loaded).objects[0].warnings, "single precision"), isWarned) << away;
  }
}

TEST(Validate, SaysWhenCastersAreTooFarApartForOneMap) {
  EXPECT_FALSE(anyContains(validateScene(*makeBuiltinScene("spheres81")).warnings, "texels"));
  scene::SceneDescription world = *makeBuiltinScene("box");
  world.objects.push_back(world.objects.front());
  world.objects.back().worldFromObject[3] += glm::dvec4(3000, 0, 0, 0);
  EXPECT_TRUE(anyContains(validateScene(world).warnings, "texels"));
}

}  // namespace
}  // namespace halfshadow::scenes
