// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/trigonometric.hpp>

#include "gltf_writer.hpp"

namespace halfshadow::scenes {
namespace {
using testing::anyNoteContains;
using testing::areaVector;
using testing::GltfWriter;
using testing::Json;
using testing::quadWriter;

// Positions are floats of order one: 1e-6 is ten roundings, any wrong rule is off by a tenth or more.
constexpr double kTiny = 1e-6;

scene::SceneDescription loaded(const GltfWriter& writer, const GltfOptions& options = {}) {
  auto result = writer.load(options);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return result.ok() ? *result : scene::SceneDescription{};
}

/// World position of vertex `vertex` of the first object.
glm::dvec3 vertexWorld(const scene::SceneDescription& description, std::size_t vertex) {
  const scene::SceneObject& object = description.objects.at(0);
  return glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(object.mesh->positions.at(vertex)), 1.0));
}

TEST(GltfGeometry, IndexedTriangles) {
  const scene::SceneDescription description = loaded(quadWriter());
  ASSERT_EQ(description.objects.size(), 1u);
  EXPECT_EQ(description.objects[0].mesh->triangleCount(), 2u);
  EXPECT_LT(glm::length(areaVector(description.objects[0]) - glm::dvec3(0, 0, 1)), kTiny);
  EXPECT_TRUE(description.objects[0].casts && description.objects[0].receives);
}

TEST(GltfGeometry, IndicesOf8And32Bits) {
  GltfWriter bytes = quadWriter();
  bytes.primitive()["indices"] =
      bytes.addAccessor(std::vector<std::uint8_t>{0, 1, 2, 1, 3, 2}, testing::kUnsignedByte, "SCALAR", 1);
  EXPECT_EQ(loaded(bytes).objects.at(0).mesh->indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
  GltfWriter ints = quadWriter();
  ints.primitive()["indices"] =
      ints.addAccessor(std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}, testing::kUnsignedInt, "SCALAR", 1);
  EXPECT_EQ(loaded(ints).objects.at(0).mesh->indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
}

TEST(GltfGeometry, StripsAndFansKeepTheirOrientation) {
  for (const int mode : {5, 6}) {
    GltfWriter writer;
    // A unit square: as a strip in zigzag order, as a fan around its border.
    const std::vector<float> strip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const std::vector<float> fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const int position = writer.addAccessor(mode == 5 ? strip : fan, testing::kFloat, "VEC3", 3);
    writer.addPrimitive({{"attributes", {{"POSITION", position}}}, {"mode", mode}});
    const scene::SceneDescription description = loaded(writer);
    ASSERT_EQ(description.objects.size(), 1u);
    EXPECT_EQ(description.objects[0].mesh->triangleCount(), 2u);
    EXPECT_LT(glm::length(areaVector(description.objects[0]) - glm::dvec3(0, 0, 1)), kTiny)
        << "mode " << mode;
  }
}

TEST(GltfGeometry, InterleavedAttributes) {
  GltfWriter writer;
  // x y z, u v per vertex: 20 bytes.
  const int view =
      writer.addView(std::vector<float>{0, 0, 0, .1f, .2f, 1, 0, 0, .3f, .4f, 0, 1, 0, .5f, .6f}, 20);
  const int position =
      writer.addAccessor({{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  const int texcoord = writer.addAccessor(
      {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
  writer.addPrimitive({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", texcoord}}}});
  const scene::SceneDescription description = loaded(writer);
  EXPECT_EQ(description.objects.at(0).mesh->positions[2], glm::vec3(0, 1, 0));
  EXPECT_EQ(description.objects.at(0).mesh->texcoords[2], glm::vec2(.5f, .6f));
}

TEST(GltfGeometry, NormalisedIntegerPositions) {
  GltfWriter writer;
  const int view =
      writer.addView(std::vector<std::int16_t>{-32767, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0}, 8);
  const int position = writer.addAccessor(
      {{"bufferView", view}, {"componentType", 5122}, {"count", 3}, {"type", "VEC3"}, {"normalized", true}});
  writer.addPrimitive({{"attributes", {{"POSITION", position}}}});
  writer.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const scene::SceneDescription description = loaded(writer);
  EXPECT_EQ(vertexWorld(description, 0), glm::dvec3(-1, 0, 0));
  EXPECT_EQ(vertexWorld(description, 2), glm::dvec3(0, -1, 0)) << "-32768 is clamped to -1";
}

TEST(GltfGeometry, SparseAccessors) {
  GltfWriter writer = quadWriter();
  const int indices = writer.addView(std::vector<std::uint8_t>{3});
  const int values = writer.addView(std::vector<float>{2, 2, 0});
  writer.json["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", values}}}};
  const scene::SceneDescription description = loaded(writer);
  EXPECT_EQ(vertexWorld(description, 3), glm::dvec3(2, 2, 0));
  EXPECT_EQ(vertexWorld(description, 1), glm::dvec3(1, 0, 0));
}

TEST(GltfGeometry, EveryPrimitiveIsAnObjectAndLinesAreSkipped) {
  GltfWriter writer = quadWriter();
  Json second = writer.primitive();
  writer.addPrimitive(second);
  second["mode"] = 1;
  writer.addPrimitive(second);
  const scene::SceneDescription description = loaded(writer);
  EXPECT_EQ(description.objects.size(), 2u);
  EXPECT_TRUE(anyNoteContains(description, "points or lines"));
}

TEST(GltfNodes, HierarchyOfMatrixAndTrs) {
  GltfWriter writer = quadWriter();
  const double s = std::sqrt(0.5);
  writer.json["nodes"] =
      Json::array({{{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}},
                   {{"mesh", 0},
                    {"translation", {0, 5, 0}},
                    {"rotation", {0, 0, s, s}},  // 90° about z
                    {"scale", {2, 1, 1}}}});
  const scene::SceneDescription description = loaded(writer);
  EXPECT_LT(glm::length(vertexWorld(description, 1) - glm::dvec3(10, 7, 0)), kTiny);
  EXPECT_LT(glm::length(vertexWorld(description, 2) - glm::dvec3(9, 5, 0)), kTiny);
}

TEST(GltfNodes, MirroredNodesStayWoundOutwardInBothSpaces) {
  GltfWriter writer = quadWriter();
  writer.json["nodes"][0]["scale"] = {1, -3, 1};
  const scene::SceneDescription description = loaded(writer);
  const scene::SceneObject& object = description.objects.at(0);
  EXPECT_GT(glm::determinant(glm::dmat3(object.worldFromObject)), 0.0);
  EXPECT_LT(glm::length(areaVector(object) - glm::dvec3(0, 0, 3)), kTiny) << "still faces +z";
  const scene::Bounds bounds = scene::boundsWorld(description, scene::ObjectFilter::all);
  EXPECT_LT(glm::length(bounds.low - glm::dvec3(0, -3, 0)), kTiny);
}

TEST(GltfNodes, NodesShareUndeformedMeshes) {
  GltfWriter writer = quadWriter();
  writer.json["nodes"] = Json::array({{{"mesh", 0}}, {{"mesh", 0}, {"translation", {3, 0, 0}}}});
  writer.json["scenes"][0]["nodes"] = {0, 1};
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.objects.size(), 2u);
  EXPECT_EQ(description.objects[0].mesh, description.objects[1].mesh);
}

TEST(GltfNodes, OnlyTheDefaultSceneIsLoaded) {
  GltfWriter writer = quadWriter();
  writer.json["nodes"] = Json::array({{{"mesh", 0}, {"name", "first"}}, {{"mesh", 0}, {"name", "second"}}});
  writer.json["scenes"] = Json::array({{{"nodes", {0}}}, {{"nodes", {1}}}});
  writer.json["scene"] = 1;
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.objects.size(), 1u);
  EXPECT_EQ(description.objects[0].name, "second");
}

TEST(GltfNodes, ExtrasSetCastsAndReceives) {
  GltfWriter writer = quadWriter();
  writer.json["nodes"] =
      Json::array({{{"mesh", 0}, {"extras", {{"halfshadow", {{"casts", false}}}}}, {"children", {1}}},
                   {{"mesh", 0}, {"extras", {{"halfshadow", {{"receives", false}}}}}}});
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.objects.size(), 2u);
  EXPECT_FALSE(description.objects[0].casts);
  EXPECT_TRUE(description.objects[0].receives);
  EXPECT_FALSE(description.objects[1].casts) << "inherited";
  EXPECT_FALSE(description.objects[1].receives);
}

TEST(GltfCameras, BecomeEyeTargetAndFieldOfView) {
  GltfWriter writer = quadWriter();
  writer.json["cameras"] =
      Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}});
  const double s = std::sqrt(0.5);
  writer.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 4, 0}}, {"rotation", {-s, 0, 0, s}}});
  writer.json["scenes"][0]["nodes"] = {0, 1};
  const scene::SceneDescription description = loaded(writer);
  ASSERT_TRUE(description.camera.has_value());
  EXPECT_DOUBLE_EQ(description.camera->verticalFovRadians, 0.7);
  EXPECT_LT(glm::length(description.camera->eyeWorld - glm::dvec3(0, 4, 0)), kTiny);
  const glm::dvec3 forward = glm::normalize(description.camera->targetWorld - description.camera->eyeWorld);
  EXPECT_LT(glm::length(forward - glm::dvec3(0, -1, 0)), kTiny) << "turned by -90° about x: looks down";
}

Json lightExtension(const Json& lights) {
  return {{"KHR_lights_punctual", {{"lights", lights}}}};
}

TEST(GltfLights, PunctualLightsBecomeRectangles) {
  GltfWriter writer = quadWriter();
  writer.json["extensions"] =
      lightExtension(Json::array({{{"type", "spot"},
                                   {"spot", Json::object()},
                                   {"intensity", 50},
                                   {"extras", {{"halfshadow", {{"size", {2, 0.5}}}}}}},
                                  {{"type", "point"}, {"intensity", 200}, {"color", {1, 0.5, 0}}}}));
  const double s = std::sqrt(0.5);
  writer.json["nodes"].push_back({{"translation", {1, 6, 2}},
                                  {"rotation", {-s, 0, 0, s}},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  writer.json["nodes"].push_back({{"translation", {0, 3, 0}},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}},
                                  {"extras", {{"halfshadow", {{"size", 1}}}}}});
  writer.json["scenes"][0]["nodes"] = {0, 1, 2};
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.lights.size(), 2u);
  const scene::AreaLight& spot = description.lights[0];
  EXPECT_LT(glm::length(spot.centerWorld - glm::dvec3(1, 6, 2)), kTiny);
  EXPECT_LT(glm::length(spot.emission - glm::dvec3(0, -1, 0)), kTiny);
  EXPECT_NEAR(glm::length(spot.halfU), 1.0, kTiny);
  EXPECT_NEAR(glm::length(spot.halfV), 0.25, kTiny);
  EXPECT_NEAR(spot.intensity, 0.25, kTiny) << "relative to the brightest";
  const scene::AreaLight& point = description.lights[1];
  EXPECT_NEAR(glm::length(point.halfU), 0.5, kTiny);
  EXPECT_EQ(point.color, glm::vec3(1, 0.5f, 0));
}

TEST(GltfLights, WithoutASizeTheyArePoints) {
  GltfWriter writer = quadWriter();
  writer.json["extensions"] = lightExtension(Json::array({{{"type", "point"}}}));
  writer.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.lights.size(), 1u);
  EXPECT_EQ(description.lights[0].halfU, glm::dvec3(0.0));
}

TEST(GltfLights, DirectionalLightsAreParallelAndAsWideAsTheSun) {
  for (const double degrees : {0.0, 2.0}) {
    GltfWriter writer = quadWriter();
    writer.json["extensions"] = lightExtension(Json::array({{{"type", "directional"}}}));
    const double s = std::sqrt(0.5);
    writer.json["nodes"].push_back({{"translation", {99, 99, 99}},
                                    {"rotation", {-s, 0, 0, s}},  // shines down
                                    {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    if (degrees > 0.0) writer.json["nodes"][1]["extras"] = {{"halfshadow", {{"size", degrees}}}};
    writer.json["scenes"][0]["nodes"] = {0, 1};
    const scene::SceneDescription description = loaded(writer);
    ASSERT_EQ(description.lights.size(), 1u);
    const scene::AreaLight& sun = description.lights[0];
    for (const glm::dvec3& corner : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
      const glm::dvec3 way = sun.centerWorld - corner;
      EXPECT_LT(glm::degrees(std::acos(glm::normalize(way).y)), 0.06) << "the same direction everywhere";
      const double seen = glm::degrees(2.0 * std::atan(glm::length(sun.halfU) / glm::length(way)));
      EXPECT_NEAR(seen, degrees > 0.0 ? degrees : 0.53, 0.003);
    }
    EXPECT_EQ(sun.referenceDistance, 0.0) << "as bright everywhere";
  }
}

TEST(GltfLights, SpotsHaveTheirConesAndPointsShineAtTheScene) {
  GltfWriter writer = quadWriter();
  writer.json["extensions"] = lightExtension(
      Json::array({{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}}},
                   {{"type", "point"}}}));
  writer.json["nodes"].push_back(
      {{"translation", {0.5, 0.5, 4}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  writer.json["nodes"].push_back({{"translation", {0.5, 0.5, -4}},  // its own -z leads away from the quad
                                  {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
  writer.json["scenes"][0]["nodes"] = {0, 1, 2};
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.lights.size(), 2u);
  EXPECT_DOUBLE_EQ(description.lights[0].innerConeRadians, 0.2);
  EXPECT_DOUBLE_EQ(description.lights[0].outerConeRadians, 0.5);
  EXPECT_DOUBLE_EQ(description.lights[1].outerConeRadians, 0.0);
  EXPECT_LT(glm::length(description.lights[1].emission - glm::dvec3(0, 0, 1)), kTiny);
}

/// A quad whose node is moved by one animation channel.
GltfWriter animatedWriter(const char* path, const char* interpolation, const std::vector<float>& times,
                          const std::vector<float>& values, const char* type, std::size_t components) {
  GltfWriter writer = quadWriter();
  const int input = writer.addAccessor(times, testing::kFloat, "SCALAR", 1);
  const int output = writer.addAccessor(values, testing::kFloat, type, components);
  writer.json["animations"] = Json::array(
      {{{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}})},
        {"samplers",
         Json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})}}});
  return writer;
}

TEST(GltfAnimation, StepLinearAndClamping) {
  const auto xAt = [](const char* interpolation, double seconds) {
    const GltfWriter writer =
        animatedWriter("translation", interpolation, {1, 3}, {10, 0, 0, 20, 0, 0}, "VEC3", 3);
    return vertexWorld(loaded(writer, {.animationTimeSeconds = seconds}), 0).x;
  };
  EXPECT_NEAR(xAt("LINEAR", 0), 10, kTiny);
  EXPECT_NEAR(xAt("LINEAR", 1.5), 12.5, kTiny);
  EXPECT_NEAR(xAt("LINEAR", 9), 20, kTiny);
  EXPECT_NEAR(xAt("STEP", 2.9), 10, kTiny);
  EXPECT_NEAR(xAt("STEP", 3.0), 20, kTiny);
}

TEST(GltfAnimation, CubicSpline) {
  // Values 0 and 1 at t = 0 and 2 with tangents 1 and 0: at the middle 0.5·0 + 0.125·2·1 + 0.5·1 - 0 = 0.75.
  const GltfWriter writer = animatedWriter("translation", "CUBICSPLINE", {0, 2},
                                           {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3", 3);
  EXPECT_NEAR(vertexWorld(loaded(writer, {.animationTimeSeconds = 1}), 0).x, 0.75, kTiny);
}

TEST(GltfAnimation, RotationTakesTheShortWayAtConstantSpeed) {
  const float s = std::sqrt(0.5f);
  // From 0° to 90° about z, the second quaternion with its sign flipped.
  const GltfWriter writer =
      animatedWriter("rotation", "LINEAR", {0, 3}, {0, 0, 0, 1, 0, 0, -s, -s}, "VEC4", 4);
  const glm::dvec3 p = vertexWorld(loaded(writer, {.animationTimeSeconds = 1}), 1);
  EXPECT_LT(glm::length(p - glm::dvec3(std::cos(glm::radians(30.0)), 0.5, 0)), kTiny);
}

TEST(GltfAnimation, RestPoseOnRequest) {
  const GltfWriter writer = animatedWriter("translation", "LINEAR", {0}, {7, 0, 0}, "VEC3", 3);
  EXPECT_NEAR(vertexWorld(loaded(writer), 0).x, 7, kTiny);
  EXPECT_NEAR(vertexWorld(loaded(writer, {.animationIndex = -1}), 0).x, 0, kTiny);
  const auto missing = writer.load({.animationIndex = 4});
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::invalidArgument);
}

TEST(GltfAnimation, MorphWeights) {
  GltfWriter writer = animatedWriter("weights", "LINEAR", {0, 1}, {0, 1}, "SCALAR", 1);
  const int offsets =
      writer.addAccessor(std::vector<float>{0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0}, testing::kFloat, "VEC3", 3);
  writer.primitive()["targets"] = Json::array({{{"POSITION", offsets}}});
  EXPECT_NEAR(vertexWorld(loaded(writer, {.animationTimeSeconds = 0.25}), 0).z, 1.0, kTiny);
}

TEST(GltfSkin, JointsMoveTheirVertices) {
  GltfWriter writer = quadWriter();
  const int joints =
      writer.addAccessor(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0},
                         testing::kUnsignedByte, "VEC4", 4);
  const int weights = writer.addAccessor(
      std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, .5f, .5f, 0, 0, 1, 0, 0, 0}, testing::kFloat, "VEC4", 4);
  writer.primitive()["attributes"]["JOINTS_0"] = joints;
  writer.primitive()["attributes"]["WEIGHTS_0"] = weights;
  writer.json["skins"] = Json::array({{{"joints", {1, 2}}}});
  writer.json["nodes"] = Json::array({{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                                      {{"translation", {0, 0, 0}}},
                                      {{"translation", {0, 0, 8}}}});
  writer.json["scenes"][0]["nodes"] = {0, 1, 2};
  const scene::SceneDescription description = loaded(writer);
  EXPECT_LT(glm::length(vertexWorld(description, 0) - glm::dvec3(0, 0, 0)), kTiny)
      << "the node's place is ignored";
  EXPECT_LT(glm::length(vertexWorld(description, 1) - glm::dvec3(1, 0, 8)), kTiny);
  EXPECT_LT(glm::length(vertexWorld(description, 2) - glm::dvec3(0, 1, 4)), kTiny);
}

/// A tetrahedron in two primitives (bottom and sides) of one skin with one joint below `root`.
GltfWriter skinnedTetrahedron(const Json& root, const Json& joint) {
  GltfWriter writer;
  const int position = writer.addAccessor(std::vector<float>{0, 0, 0, .3f, 0, 0, 0, .7f, 0, 0, 0, 1.1f},
                                          testing::kFloat, "VEC3", 3);
  const int joints = writer.addAccessor(std::vector<std::uint8_t>(16, 0), testing::kUnsignedByte, "VEC4", 4);
  const int weights = writer.addAccessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
                                         testing::kFloat, "VEC4", 4);
  for (const std::vector<std::uint16_t>& corners :
       {std::vector<std::uint16_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3},
        std::vector<std::uint16_t>{0, 2, 1}}) {
    const int indices = writer.addAccessor(corners, testing::kUnsignedShort, "SCALAR", 1);
    writer.addPrimitive(
        {{"attributes", {{"POSITION", position}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
         {"indices", indices}});
  }
  writer.json["skins"] = Json::array({{{"joints", {1}}}});
  writer.json["nodes"] = Json::array({{{"mesh", 0}, {"skin", 0}}, joint, root});
  writer.json["nodes"][2]["children"] = {1};
  writer.json["scenes"][0]["nodes"] = {0, 2};
  return writer;
}

TEST(GltfSkin, KeepsItsShapeWhereverTheSkeletonStands) {
  const double place = 12345678.125;
  const scene::SceneDescription near =
      loaded(skinnedTetrahedron({{"translation", {0, 0, 0}}}, {{"translation", {.1, .2, .3}}}));
  const scene::SceneDescription far =
      loaded(skinnedTetrahedron({{"translation", {place, 0, -place}}}, {{"translation", {.1, .2, .3}}}));
  for (std::size_t object = 0; object < 2; ++object) {
    EXPECT_EQ(far.objects[object].worldFromObject, far.objects[0].worldFromObject)
        << "primitives of a node share a place, so that shared vertices stay shared";
    for (std::size_t i = 0; i < 4; ++i) {
      const auto worldOf = [&](const scene::SceneDescription& scene) {
        const scene::SceneObject& o = scene.objects[object];
        return glm::dvec3(o.worldFromObject * glm::dvec4(glm::dvec3(o.mesh->positions[i]), 1.0));
      };
      EXPECT_LT(glm::length(worldOf(far) - worldOf(near) - glm::dvec3(place, 0, -place)), 2e-7);
    }
  }
}

TEST(GltfSkin, AMirroredSkeletonIsWoundOutwardLikeItsTwin) {
  const auto volumeOf = [](const scene::SceneDescription& scene) {
    const scene::TriangleMesh& mesh = *scene.objects[0].mesh;
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
      sum += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
    }
    return sum * glm::determinant(glm::dmat3(scene.objects[0].worldFromObject));
  };
  const double expected = .3 * .7 * 1.1 / 6.0;
  EXPECT_NEAR(volumeOf(loaded(skinnedTetrahedron({{"scale", {1, 1, 1}}}, {{"translation", {.1, .2, .3}}}))),
              expected, 1e-6);
  EXPECT_NEAR(volumeOf(loaded(skinnedTetrahedron({{"scale", {-1, 1, 1}}}, {{"translation", {.1, .2, .3}}}))),
              expected, 1e-6);
}

TEST(GltfMaterials, ColourAndDecodedImage) {
  GltfWriter writer = quadWriter();
  const int texcoord =
      writer.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, testing::kFloat, "VEC2", 2);
  writer.primitive()["attributes"]["TEXCOORD_0"] = texcoord;
  writer.primitive()["material"] = 0;
  writer.json["materials"] =
      Json::array({{{"doubleSided", true},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {1, 0.5, 0.25, 1}}, {"baseColorTexture", {{"index", 0}}}}}}});
  writer.json["textures"] = Json::array({{{"source", 0}}});
  // A 1 × 1 red PNG.
  writer.json["images"] = Json::array(
      {{{"uri",
         "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/"
         "pLvAAAAAElFTkSuQmCC"}}});
  const scene::SceneDescription description = loaded(writer);
  const scene::Material& material = description.objects.at(0).material;
  EXPECT_TRUE(material.doubleSided);
  EXPECT_EQ(material.baseColor, glm::vec4(1, 0.5f, 0.25f, 1));
  ASSERT_NE(material.baseColorImage, nullptr) << (description.notes.empty() ? "" : description.notes[0]);
  EXPECT_EQ(material.baseColorImage->width, 1);
  EXPECT_EQ(material.baseColorImage->pixels[0], 255);
  EXPECT_EQ(material.baseColorImage->pixels[1], 0);
}

TEST(GltfMaterials, ABrokenImageIsANote) {
  GltfWriter writer = quadWriter();
  const int view = writer.addView(std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8});
  writer.primitive()["material"] = 0;
  writer.json["materials"] =
      Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  writer.json["textures"] = Json::array({{{"source", 0}}});
  writer.json["images"] = Json::array({{{"bufferView", view}, {"mimeType", "image/png"}}});
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.objects.size(), 1u);
  EXPECT_EQ(description.objects[0].material.baseColorImage, nullptr);
  EXPECT_TRUE(anyNoteContains(description, "image 0"));
}

TEST(GltfFiles, TextFormWithExternalBuffer) {
  GltfWriter writer = quadWriter();
  const std::string bin =
      GltfWriter::writeFile("buffer.bin", std::string(writer.bytes.begin(), writer.bytes.end()));
  writer.json["buffers"] =
      Json::array({{{"byteLength", writer.bytes.size()}, {"uri", bin.substr(bin.find_last_of('/') + 1)}}});
  const auto result = loadGltf(GltfWriter::writeFile("scene.gltf", writer.json.dump()), {});
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_EQ(result->objects.size(), 1u);
}

}  // namespace
}  // namespace halfshadow::scenes
