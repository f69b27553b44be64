// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What files use beyond plain triangles, against its meaning written out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "gltf_writer.hpp"

namespace halfshadow::scenes {
namespace {
using testing::anyNoteContains;
using testing::GltfWriter;
using testing::Json;
using testing::quadWriter;

constexpr double kTiny = 1e-6;

scene::SceneDescription loaded(const GltfWriter& writer, const GltfOptions& options = {}) {
  auto result = writer.load(options);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return result.ok() ? *result : scene::SceneDescription{};
}

glm::dvec3 vertexWorld(const scene::SceneObject& object, std::size_t vertex) {
  return glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(object.mesh->positions.at(vertex)), 1.0));
}

/// A quad with texture coordinates 0 to 1 and a material.
GltfWriter texturedQuad(const Json& material) {
  GltfWriter writer = quadWriter();
  writer.primitive()["attributes"]["TEXCOORD_0"] =
      writer.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, testing::kFloat, "VEC2", 2);
  writer.primitive()["attributes"]["TEXCOORD_1"] =
      writer.addAccessor(std::vector<float>{5, 5, 6, 5, 5, 6, 6, 6}, testing::kFloat, "VEC2", 2);
  writer.primitive()["material"] = 0;
  writer.json["materials"] = Json::array({material});
  writer.json["textures"] = Json::array({{{"source", 0}}});
  writer.json["images"] = Json::array(
      {{{"uri",
         "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/"
         "pLvAAAAAElFTkSuQmCC"}}});
  return writer;
}

TEST(GltfInstances, AreCopiesOfTheNode) {
  GltfWriter writer = quadWriter();
  const float s = std::sqrt(0.5f);
  const int places =
      writer.addAccessor(std::vector<float>{0, 0, 0, 4, 0, 0, 0, 7, 0}, testing::kFloat, "VEC3", 3);
  const int turns =
      writer.addAccessor(std::vector<float>{0, 0, 0, 1, 0, 0, s, s, 0, 0, 0, 1}, testing::kFloat, "VEC4", 4);
  const int sizes =
      writer.addAccessor(std::vector<float>{1, 1, 1, 2, 1, 1, 1, 1, -1}, testing::kFloat, "VEC3", 3);
  writer.json["nodes"][0]["translation"] = {100, 0, 0};
  writer.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", places}, {"ROTATION", turns}, {"SCALE", sizes}};
  writer.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.objects.size(), 3u);
  EXPECT_LT(glm::length(vertexWorld(description.objects[0], 1) - glm::dvec3(101, 0, 0)), kTiny);
  // Scaled by 2 along x, then turned by 90 degrees about z, then moved.
  EXPECT_LT(glm::length(vertexWorld(description.objects[1], 1) - glm::dvec3(104, 2, 0)), kTiny);
  EXPECT_LT(glm::length(vertexWorld(description.objects[2], 1) - glm::dvec3(101, 7, 0)), kTiny);
  EXPECT_GT(glm::determinant(glm::dmat3(description.objects[2].worldFromObject)), 0.0) << "unmirrored";
  EXPECT_EQ(description.objects[0].mesh, description.objects[1].mesh) << "shared";
  writer.json["accessors"][sizes]["count"] = 2;
  EXPECT_FALSE(writer.load().ok()) << "counts differ";
}

TEST(GltfVisibility, HiddenNodesAndTheirChildrenAreLeftOut) {
  GltfWriter writer = quadWriter();
  const Json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
  writer.json["nodes"] = Json::array(
      {{{"mesh", 0}, {"name", "seen"}},
       {{"children", {2}}, {"extensions", hidden}},
       {{"mesh", 0}, {"name", "below"}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}}});
  writer.json["scenes"][0]["nodes"] = {0, 1};
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.objects.size(), 1u);
  EXPECT_EQ(description.objects[0].name, "seen");
}

/// One channel of KHR_animation_pointer with two key times, 0 and 1.
void addPointer(GltfWriter& writer, const char* pointer, const std::vector<float>& values, const char* type,
                std::size_t components, const char* interpolation) {
  const int input = writer.addAccessor(std::vector<float>{0, 1}, testing::kFloat, "SCALAR", 1);
  const int output = writer.addAccessor(values, testing::kFloat, type, components);
  const Json target = {{"path", "pointer"},
                       {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
  writer.json["animations"] = Json::array(
      {{{"channels", Json::array({{{"sampler", 0}, {"target", target}}})},
        {"samplers",
         Json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})}}});
}

TEST(GltfPointers, MoveMorphAndHide) {
  GltfWriter moved = quadWriter();
  addPointer(moved, "/nodes/0/translation", {0, 0, 0, 8, 0, 0}, "VEC3", 3, "LINEAR");
  EXPECT_NEAR(vertexWorld(loaded(moved, {.animationTimeSeconds = 0.25}).objects.at(0), 0).x, 2.0, kTiny);

  GltfWriter morphed = quadWriter();
  const int offsets =
      morphed.addAccessor(std::vector<float>{0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0}, testing::kFloat, "VEC3", 3);
  morphed.primitive()["targets"] = Json::array({{{"POSITION", offsets}}});
  addPointer(morphed, "/meshes/0/weights", {0, 1}, "SCALAR", 1, "LINEAR");
  EXPECT_NEAR(vertexWorld(loaded(morphed, {.animationTimeSeconds = 0.5}).objects.at(0), 0).z, 2.0, kTiny);

  GltfWriter blinking = quadWriter();
  blinking.json["nodes"].push_back({{"mesh", 0}});
  blinking.json["scenes"][0]["nodes"] = {0, 1};
  addPointer(blinking, "/nodes/1/extensions/KHR_node_visibility/visible", {1, 0}, "SCALAR", 1, "STEP");
  EXPECT_EQ(loaded(blinking, {.animationTimeSeconds = 0.5}).objects.size(), 2u);
  EXPECT_EQ(loaded(blinking, {.animationTimeSeconds = 1.5}).objects.size(), 1u);

  GltfWriter other = quadWriter();
  addPointer(other, "/materials/0/emissiveFactor", {0, 0, 0, 1, 1, 1}, "VEC3", 3, "LINEAR");
  EXPECT_TRUE(anyNoteContains(loaded(other), "emissiveFactor"));
}

TEST(GltfTextures, SecondCoordinatesAndTransforms) {
  const double c = std::cos(glm::radians(30.0)), s = std::sin(glm::radians(30.0));
  const Json transform = {{"offset", {0.25, 0.5}}, {"rotation", glm::radians(30.0)}, {"scale", {2, 3}}};
  const auto texcoordOf = [&](const Json& texture, std::size_t vertex) {
    const auto description =
        loaded(texturedQuad({{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}}));
    return glm::dvec2(description.objects.at(0).mesh->texcoords.at(vertex));
  };
  EXPECT_EQ(texcoordOf({{"index", 0}, {"texCoord", 1}}, 1), glm::dvec2(6, 5));
  const Json plain = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
  // (u, v) of vertex 1 is (1, 0), of vertex 2 (0, 1): scaled, turned counter-clockwise with v downward,
  // moved.
  EXPECT_LT(glm::length(texcoordOf(plain, 0) - glm::dvec2(0.25, 0.5)), kTiny);
  EXPECT_LT(glm::length(texcoordOf(plain, 1) - glm::dvec2(0.25 + 2 * c, 0.5 - 2 * s)), kTiny);
  EXPECT_LT(glm::length(texcoordOf(plain, 2) - glm::dvec2(0.25 + 3 * s, 0.5 + 3 * c)), kTiny);
  Json both = plain;
  both["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}};
  EXPECT_EQ(texcoordOf(both, 1), glm::dvec2(6, 5)) << "the extension's set counts";
}

TEST(GltfTextures, WebPIsDecodedAndKtx2Named) {
  GltfWriter webp = texturedQuad({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  webp.json["textures"] = Json::array({{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}});
  webp.json["images"] = Json::array({{{"uri",
                                       "data:image/webp;base64,UklGRiQAAABXRUJQVlA4IBgAAAAwAQCdASoBAAEAAUAmJa"
                                       "QAA3AA/v89WAAAAA=="}}});
  webp.json["extensionsRequired"] = {"EXT_texture_webp"};
  const scene::SceneDescription description = loaded(webp);
  ASSERT_NE(description.objects.at(0).material.baseColorImage, nullptr)
      << (description.notes.empty() ? "" : description.notes[0]);
  EXPECT_EQ(description.objects[0].material.baseColorImage->width, 1);

  GltfWriter ktx = webp;
  std::vector<std::uint8_t> bytes{0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, 13, 10, 26, 10};
  const int view = ktx.addView(bytes);
  ktx.json["textures"] = Json::array({{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}});
  ktx.json["images"] = Json::array({{{"bufferView", view}, {"mimeType", "image/ktx2"}}});
  ktx.json["extensionsRequired"] = {"KHR_texture_basisu"};
  EXPECT_TRUE(anyNoteContains(loaded(ktx), "KTX 2"));
}

TEST(GltfMaterials, AlphaDecidesWhatIsThere) {
  const auto opened = [](const char* mode, double alpha, double cutoff) {
    Json material = {{"alphaMode", mode}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}};
    if (cutoff >= 0.0) material["alphaCutoff"] = cutoff;
    GltfWriter writer = texturedQuad(material);
    writer.json["nodes"].push_back({{"mesh", 1}, {"name", "plain"}});
    Json primitive = writer.primitive();
    primitive.erase("material");
    writer.json["meshes"].push_back({{"primitives", Json::array({primitive})}});
    writer.json["scenes"][0]["nodes"] = {0, 1};
    return loaded(writer);
  };
  EXPECT_EQ(opened("OPAQUE", 0.0, -1).objects.size(), 2u) << "alpha means nothing";
  EXPECT_EQ(opened("BLEND", 0.0, -1).objects.size(), 1u);
  EXPECT_TRUE(anyNoteContains(opened("BLEND", 0.0, -1), "left out"));
  EXPECT_EQ(opened("BLEND", 0.6, -1).objects.size(), 2u);
  EXPECT_TRUE(anyNoteContains(opened("BLEND", 0.6, -1), "half opaque")) << "the rule is said";
  EXPECT_EQ(opened("MASK", 0.4, -1).objects.size(), 1u) << "the cutoff is 0.5 unless said";
  EXPECT_EQ(opened("MASK", 0.4, 0.3).objects.size(), 2u);
  EXPECT_EQ(opened("MASK", 0.4, 0.3).objects[0].material.alphaCutoff, 0.0f) << "without a hole";
}

TEST(GltfMaterials, ColoursOfVertices) {
  GltfWriter writer = texturedQuad({{"alphaMode", "MASK"}});
  writer.primitive()["attributes"]["COLOR_0"] =
      writer.addAccessor({{"bufferView", writer.addView(std::vector<std::uint8_t>{
                                             255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 0, 51, 51, 51, 51})},
                          {"componentType", 5121},
                          {"count", 4},
                          {"type", "VEC4"},
                          {"normalized", true}});
  const scene::SceneDescription description = loaded(writer);
  ASSERT_EQ(description.objects.size(), 1u);
  const scene::TriangleMesh& mesh = *description.objects[0].mesh;
  ASSERT_EQ(mesh.colors.size(), 4u);
  EXPECT_EQ(mesh.colors[0], glm::vec4(1, 0, 0, 1));
  EXPECT_NEAR(mesh.colors[3].a, 0.2f, 1e-6f);
  EXPECT_EQ(description.objects[0].material.alphaCutoff, 0.5f) << "their alpha cuts";
}

TEST(GltfNodes, APlaneScaledToZeroAcrossItselfIsStillAPlane) {
  const double s = std::sqrt(0.5);
  GltfWriter scaled = quadWriter();
  scaled.json["nodes"] = Json::array({{{"children", {1}}, {"translation", {1000, 2, 0}}},
                                      {{"mesh", 0}, {"scale", {3, 2, 0}}, {"rotation", {-s, 0, 0, s}}}});
  const scene::SceneDescription description = loaded(scaled);
  ASSERT_EQ(description.objects.size(), 1u);
  EXPECT_LT(glm::length(vertexWorld(description.objects[0], 3) - glm::dvec3(1003, 2, -2)), kTiny);
  EXPECT_GT(std::abs(glm::determinant(glm::dmat3(description.objects[0].worldFromObject))), 0.5);

  GltfWriter matrix = quadWriter();
  matrix.json["nodes"] =
      Json::array({{{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 5, 1}}},
                   {{"mesh", 0}, {"scale", {0, 0, 0}}, {"name", "gone"}}});
  matrix.json["scenes"][0]["nodes"] = {0, 1};
  const scene::SceneDescription flat = loaded(matrix);
  ASSERT_EQ(flat.objects.size(), 1u);
  EXPECT_LT(glm::length(vertexWorld(flat.objects[0], 3) - glm::dvec3(1, 1, 5)), kTiny);
  EXPECT_TRUE(anyNoteContains(flat, "gone"));
}

TEST(GltfAccessors, WithoutBytesAreZeros) {
  GltfWriter writer = quadWriter();
  const int indices = writer.addView(std::vector<std::uint8_t>{1, 2});
  const int values = writer.addView(std::vector<float>{3, 0, 0, 0, 3, 0});
  writer.primitive()["attributes"]["POSITION"] =
      writer.addAccessor({{"componentType", 5126},
                          {"count", 4},
                          {"type", "VEC3"},
                          {"sparse",
                           {{"count", 2},
                            {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                            {"values", {{"bufferView", values}}}}}});
  const scene::SceneDescription description = loaded(writer);
  EXPECT_EQ(vertexWorld(description.objects.at(0), 1), glm::dvec3(3, 0, 0));
  EXPECT_EQ(vertexWorld(description.objects[0], 2), glm::dvec3(0, 3, 0));
  EXPECT_EQ(vertexWorld(description.objects[0], 3), glm::dvec3(0, 0, 0));
  GltfWriter empty = quadWriter();
  empty.primitive()["attributes"]["POSITION"] =
      empty.addAccessor({{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  const auto nothing = empty.load();
  ASSERT_FALSE(nothing.ok());
  EXPECT_EQ(nothing.error().code, ErrorCode::emptyScene);
}

TEST(GltfCameras, OrthographicOnesSeeTheSameSizeAtEveryDepth) {
  GltfWriter writer = quadWriter();
  writer.json["cameras"] =
      Json::array({{{"type", "orthographic"},
                    {"orthographic", {{"xmag", 2}, {"ymag", 2}, {"znear", 0.1}, {"zfar", 100}}}}});
  writer.json["nodes"].push_back({{"camera", 0}, {"translation", {0.5, 0.5, 3}}});
  writer.json["scenes"][0]["nodes"] = {0, 1};
  const scene::SceneDescription description = loaded(writer);
  ASSERT_TRUE(description.camera.has_value());
  const glm::dmat4 clipFromWorld =
      scene::clipFromView(*description.camera, 1.0) * scene::viewFromWorld(*description.camera);
  for (const double z : {-2.0, 0.0, 2.0}) {
    for (const glm::dvec2& offset : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(-1, 2)}) {
      const glm::dvec4 clip = clipFromWorld * glm::dvec4(0.5 + offset.x, 0.5 + offset.y, z, 1.0);
      EXPECT_LT(glm::length(glm::dvec2(clip) / clip.w - offset / 2.0), 0.002) << "half a pixel of 480";
    }
  }
}

TEST(GltfExtensions, RequiredOnesAreJudgedBeforeAnythingElse) {
  GltfWriter unknown = quadWriter();
  unknown.json["extensionsRequired"] = {"ACME_teapots"};
  unknown.json["accessors"] = "not even an array";
  const auto refused = unknown.load();
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("ACME_teapots"), std::string::npos) << refused.error().message;
  for (const char* name : {"KHR_xmp_json_ld", "KHR_materials_unlit", "EXT_lights_ies",
                           "KHR_texture_transform", "KHR_materials_transmission"}) {
    GltfWriter harmless = quadWriter();
    harmless.json["extensionsUsed"] = harmless.json["extensionsRequired"] = {name};
    EXPECT_TRUE(harmless.load().ok()) << name;
  }
}

TEST(GltfExtensions, WhatIsNotHonouredIsNamedOnce) {
  GltfWriter writer = texturedQuad(
      {{"name", "window"}, {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}});
  writer.json["extensionsUsed"] = {"KHR_materials_transmission", "ACME_clouds"};
  const scene::SceneDescription description = loaded(writer);
  EXPECT_EQ(std::ranges::count_if(description.notes,
                                  [](const std::string& note) { return note.find("window") != note.npos; }),
            1);
  EXPECT_TRUE(anyNoteContains(description, "ACME_clouds"));
  GltfWriter lines = quadWriter();
  Json line = lines.primitive();
  line["mode"] = 1;
  for (int i = 0; i < 5; ++i) lines.addPrimitive(line);
  EXPECT_EQ(loaded(lines).notes.size(), 1u) << "five primitives, one sentence";
}

}  // namespace
}  // namespace halfshadow::scenes
