// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Two files that mean the same, opened, drawn by the techniques and traced: their pictures must be the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "gltf_writer.hpp"
#include "measure/engine_session.hpp"
#include "reference/reference.hpp"
#include "scenes/camera_light_options.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::scenes {
namespace {
using testing::GltfWriter;
using testing::Json;

constexpr int kWidth = 160, kHeight = 120;
// Of maps, moments and slices; with `none`, of what is seen alone.
constexpr const char* kTechniques[] = {"hard",         "pcf-masked", "pcf-quantized",      "pcss-mip",
                                       "shadow-width", "vsm",        "occlusion-textures", "sampled"};

SceneOptions options() {
  return {.camera = parseCamera("eye=0.3,5,6 target=0,0.6,0.4 fov=40").value(),
          .light = parseLight("center=1,8,1 target=0,0,0 size=0.8x0.8 up=0.2,0.1,1").value()};
}

scene::SceneDescription opened(const GltfWriter& writer, const char* name,
                               const SceneOptions& how = options()) {
  auto scene = openScene(GltfWriter::writeFile(name, writer.glb()), how);
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
  return scene.ok() ? std::move(scene).value() : scene::SceneDescription{};
}

/// A quad from (x, z) low to high at a height, with texture coordinates 0 to 1 where it is a whole card.
void addQuad(std::vector<float>& positions, std::vector<float>& texcoords,
             std::vector<std::uint32_t>& indices, const glm::vec2& low, const glm::vec2& high, float y) {
  const auto first = static_cast<std::uint32_t>(positions.size() / 3);
  for (int i = 0; i < 4; ++i) {
    positions.insert(positions.end(), {i & 1 ? high.x : low.x, y, i & 2 ? high.y : low.y});
    texcoords.insert(texcoords.end(), {i & 1 ? 1.0f : 0.0f, i & 2 ? 1.0f : 0.0f});
  }
  for (const std::uint32_t k : {0u, 2u, 1u, 1u, 2u, 3u}) indices.push_back(first + k);
}

int addMesh(GltfWriter& writer, const std::vector<float>& positions, const std::vector<float>& texcoords,
            const std::vector<std::uint32_t>& indices, int material) {
  Json primitive = {{"attributes", {{"POSITION", writer.addAccessor(positions, testing::kFloat, "VEC3", 3)}}},
                    {"indices", writer.addAccessor(indices, testing::kUnsignedInt, "SCALAR", 1)}};
  if (!texcoords.empty())
    primitive["attributes"]["TEXCOORD_0"] = writer.addAccessor(texcoords, testing::kFloat, "VEC2", 2);
  if (material >= 0) primitive["material"] = material;
  writer.json["meshes"].push_back({{"primitives", Json::array({primitive})}});
  return static_cast<int>(writer.json["meshes"].size()) - 1;
}

/// A floor that casts nothing; meshes and nodes start behind it.
GltfWriter onFloor() {
  GltfWriter writer;
  writer.json["meshes"] = Json::array();
  writer.json["nodes"] = Json::array();
  std::vector<float> positions, texcoords;
  std::vector<std::uint32_t> indices;
  addQuad(positions, texcoords, indices, {-5, -5}, {5, 5}, 0);
  writer.json["nodes"].push_back({{"mesh", addMesh(writer, positions, {}, indices, -1)},
                                  {"name", "floor"},
                                  {"extras", {{"halfshadow", {{"casts", false}}}}}});
  return writer;
}

void showAll(GltfWriter& writer) {
  Json& roots = writer.json["scenes"][0]["nodes"];
  roots = Json::array();
  for (std::size_t i = 0; i < writer.json["nodes"].size(); ++i) roots.push_back(i);
}

/// Fields of a board of n × n of which every other one is a hole.
bool isHole(int x, int y) {
  return (x + y) % 2 == 1;
}
constexpr int kFields = 4;

/// A card with holes by alpha. A nearest fetch of one texel a field, repeated `repeats` times over the card.
GltfWriter maskedCard(int repeats) {
  GltfWriter writer = onFloor();
  // 4 × 4 texels of RGBA, alpha by isHole(), as PNG.
  writer.json["images"] =
      Json::array({{{"uri",
                     "data:image/"
                     "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAYAAACp8Z5+"
                     "AAAAGUlEQVR42mOIWmDzH4gZYDQDMgdEMxBUAQChvRtZ5KPqcQAAAABJRU5ErkJggg=="}}});
  writer.json["samplers"] = Json::array({{{"magFilter", 9728}, {"minFilter", 9728}}});
  writer.json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}});
  writer.json["materials"] = Json::array(
      {{{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  std::vector<float> positions, texcoords;
  std::vector<std::uint32_t> indices;
  addQuad(positions, texcoords, indices, {-1.5f, -1.5f}, {1.5f, 1.5f}, 1.2f);
  for (float& t : texcoords) t *= static_cast<float>(repeats);
  writer.json["nodes"].push_back({{"mesh", addMesh(writer, positions, texcoords, indices, 0)}});
  showAll(writer);
  return writer;
}

GltfWriter cutCard(int repeats) {
  GltfWriter writer = onFloor();
  std::vector<float> positions, texcoords;
  std::vector<std::uint32_t> indices;
  const int fields = kFields * repeats;
  const float side = 3.0f / static_cast<float>(fields);
  for (int y = 0; y < fields; ++y) {
    for (int x = 0; x < fields; ++x) {
      if (isHole(x % kFields, y % kFields)) continue;
      const glm::vec2 low(-1.5f + side * static_cast<float>(x), -1.5f + side * static_cast<float>(y));
      addQuad(positions, texcoords, indices, low, low + side, 1.2f);
    }
  }
  writer.json["nodes"].push_back({{"mesh", addMesh(writer, positions, {}, indices, -1)}});
  showAll(writer);
  return writer;
}

class Twins : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto opened = measure::EngineSession::open({});
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    session_ = std::move(opened).value().release();
  }
  static void TearDownTestSuite() {
    delete session_;
    session_ = nullptr;
  }
  static std::vector<std::uint8_t> visibility(const scene::SceneDescription& scene, const char* technique) {
    EXPECT_TRUE(session_->renewEngine().ok());
    const Status loaded = session_->load(scene);
    EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.error().message);
    const Status chosen = session_->choose(technique, {});
    EXPECT_TRUE(chosen.ok()) << (chosen.ok() ? "" : chosen.error().message);
    RenderDesc desc{.camera = measure::cameraDesc(*scene.camera),
                    .target = {.width = kWidth, .height = kHeight},
                    .output = Output::visibility};
    FrameReport report;
    const Status rendered = session_->render(desc, report);
    EXPECT_TRUE(rendered.ok()) << (rendered.ok() ? "" : rendered.error().message);
    notes_.clear();
    for (std::size_t i = 0; i < report.skipCount; ++i) notes_ += std::string(report.skips[i].why) + "\n";
    const auto image = session_->read(kWidth, kHeight);
    EXPECT_TRUE(image.ok());
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; image.ok() && i < image->pixels.size(); i += 4) bytes.push_back(image->pixels[i]);
    return bytes;
  }
  struct Difference {
    double mean = 0.0;            ///< of 255 steps
    double shareOverEight = 0.0;  ///< of the pixels
    double shadow = 0.0;          ///< mean darkness of the first: nothing is compared where there is none
  };
  static Difference difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    Difference result;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const int apart = std::abs(int{a[i]} - int{b.at(i)});
      result.mean += apart;
      result.shareOverEight += apart > 8;
      result.shadow += 255 - a[i];
    }
    const double count = static_cast<double>(a.size());
    return {result.mean / count, result.shareOverEight / count, result.shadow / count};
  }
  static void expectEqual(const scene::SceneDescription& a, const scene::SceneDescription& b) {
    for (const char* technique : kTechniques) {
      const auto one = visibility(a, technique), other = visibility(b, technique);
      EXPECT_EQ(one, other) << technique;
      EXPECT_GT(difference(one, other).shadow, 1.0) << technique;
    }
  }
  static std::vector<float> truth(const scene::SceneDescription& scene) {
    const auto receivers =
        reference::traceReceivers(scene, *scene.camera, scene.lights.front(), kWidth, kHeight);
    EXPECT_TRUE(receivers.ok());
    const auto traced = reference::traceVisibility(scene, scene.lights.front(), *receivers, {.samples = 16});
    EXPECT_TRUE(traced.ok());
    return *traced;
  }

  static measure::EngineSession* session_;
  static std::string notes_;
};
measure::EngineSession* Twins::session_ = nullptr;
std::string Twins::notes_;

TEST_F(Twins, HolesOfAlphaAreHolesOfGeometry) {
  for (const int repeats : {1, 2}) {
    const auto masked = opened(maskedCard(repeats), "masked.glb"), cut = opened(cutCard(repeats), "cut.glb");
    ASSERT_EQ(masked.objects.size(), 2u);
    ASSERT_GT(masked.objects[1].material.alphaCutoff, 0.0f);
    // Rays that pass exactly between two fields aside, truth is the same to the last ray.
    const std::vector<float> maskedTruth = truth(masked), cutTruth = truth(cut);
    std::size_t apart = 0;
    for (std::size_t i = 0; i < cutTruth.size(); ++i) apart += maskedTruth[i] != cutTruth[i];
    EXPECT_LT(apart, cutTruth.size() / 1000) << repeats;
    for (const char* technique : kTechniques) {
      const Difference d = difference(visibility(cut, technique), visibility(masked, technique));
      EXPECT_GT(d.shadow, 5.0) << technique;
      // Texels and pixels whose centres lie on a border fall to either side.
      EXPECT_LT(d.mean, 0.5) << technique << ", " << repeats;
      EXPECT_LT(d.shareOverEight, 0.01) << technique << ", " << repeats;
    }
  }
}

TEST_F(Twins, OutlinesFollowAlpha) {
  for (const int repeats : {1, 2}) {
    const auto masked = opened(maskedCard(repeats), "masked.glb"), cut = opened(cutCard(repeats), "cut.glb");
    for (const char* technique : {"shadow-volume", "wedges", "wedges-blended", "wedges-cells"}) {
      const Difference d = difference(visibility(cut, technique), visibility(masked, technique));
      EXPECT_GT(d.shadow, 5.0) << technique;
      EXPECT_EQ(notes_.find("outlines"), std::string::npos) << technique << ": " << notes_;
      // A thousandth of an edge beside the texels' borders; the card whole would be 6 steps off.
      EXPECT_LT(d.mean, 0.5) << technique << ", " << repeats;
      EXPECT_LT(d.shareOverEight, 0.01) << technique << ", " << repeats;
    }
  }
}

/// Boxes of half size .3 on a grid, by nodes or by instances.
GltfWriter posts(bool byInstances) {
  GltfWriter writer = onFloor();
  std::vector<float> positions;
  std::vector<std::uint32_t> indices{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                     2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  for (unsigned i = 0; i < 8; ++i)
    positions.insert(positions.end(), {i & 1 ? .3f : -.3f, i & 2 ? 1.2f : 0.f, i & 4 ? .3f : -.3f});
  const int mesh = addMesh(writer, positions, {}, indices, -1);
  std::vector<float> places;
  for (int i = 0; i < 5; ++i) places.insert(places.end(), {i - 2.0f, 0.25f * i, 0.5f * (i % 2)});
  if (byInstances) {
    const int accessor = writer.addAccessor(places, testing::kFloat, "VEC3", 3);
    writer.json["nodes"].push_back(
        {{"mesh", mesh},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", accessor}}}}}}}});
  } else {
    for (int i = 0; i < 5; ++i) {
      writer.json["nodes"].push_back(
          {{"mesh", mesh}, {"translation", {places[3 * i], places[3 * i + 1], places[3 * i + 2]}}});
    }
  }
  showAll(writer);
  return writer;
}

TEST_F(Twins, InstancesAreCopies) {
  expectEqual(opened(posts(true), "instances.glb"), opened(posts(false), "copies.glb"));
}

/// A flag of two triangles and a pole, open: mirrored by its root, or written down mirrored.
GltfWriter flag(bool byRoot, bool skinned) {
  GltfWriter writer = onFloor();
  const float side = byRoot ? 1.0f : -1.0f;
  const std::vector<float> positions{side * .1f, 0, 0, side * .2f, 0, 0,    side * .1f,  2,    0,
                                     side * .2f, 2, 0, side * .2f, 1, 0.1f, side * 1.6f, 1.6f, .4f};
  std::vector<std::uint32_t> indices{0, 1, 2, 1, 3, 2, 3, 4, 5};
  // What a transform mirrors keeps its front.
  for (std::size_t i = 0; !byRoot && i < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
  const int mesh = addMesh(writer, positions, {}, indices, -1);
  Json node = {{"mesh", mesh}};
  if (skinned) {
    Json& attributes = writer.json["meshes"][mesh]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] =
        writer.addAccessor(std::vector<std::uint8_t>(24, 0), testing::kUnsignedByte, "VEC4", 4);
    std::vector<float> weights;
    for (int i = 0; i < 6; ++i) weights.insert(weights.end(), {1, 0, 0, 0});
    attributes["WEIGHTS_0"] = writer.addAccessor(weights, testing::kFloat, "VEC4", 4);
    writer.json["skins"] = Json::array({{{"joints", {2}}}});
    node["skin"] = 0;
  }
  writer.json["nodes"].push_back(node);
  writer.json["nodes"].push_back({{"name", "joint"}});
  Json root = {{"children", {1, 2}}};
  if (byRoot) root["scale"] = {-1, 1, 1};
  writer.json["nodes"].push_back(root);
  writer.json["scenes"][0]["nodes"] = {0, 3};
  return writer;
}

TEST_F(Twins, WhatItsRootMirrorsIsTheMirrorImage) {
  for (const bool skinned : {false, true})
    expectEqual(opened(flag(true, skinned), "root.glb"), opened(flag(false, skinned), "written.glb"));
}

/// A floor, and over it a card whose front faces down, away from the camera.
GltfWriter cardFacingDown(bool mirrored, bool isSeen) {
  GltfWriter writer = onFloor();
  std::vector<float> positions, texcoords;
  std::vector<std::uint32_t> indices;
  addQuad(positions, texcoords, indices, {-1, -1}, {1, 1}, 1.2f);
  for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
  Json node = {{"mesh", addMesh(writer, positions, {}, indices, 0)}};
  if (mirrored) node["scale"] = {-1, 1, 1};
  if (!isSeen) node["extras"] = {{"halfshadow", {{"receives", false}}}};
  writer.json["nodes"].push_back(node);
  writer.json["materials"] = Json::array({Json::object()});
  showAll(writer);
  return writer;
}

TEST_F(Twins, BackFacesOfSingleSidedCardsCastUnseen) {
  SceneOptions asInFile = options(), bothSides = options();
  bothSides.sides = Sides::both;
  for (const bool mirrored : {false, true}) {
    const auto card = opened(cardFacingDown(mirrored, true), "card.glb", asInFile);
    ASSERT_EQ(card.objects.size(), 2u);
    EXPECT_FALSE(scene::showsBackFaces(*card.objects[1].mesh, card.objects[1].material));
    const auto hidden = opened(cardFacingDown(mirrored, false), "hidden.glb", asInFile);
    const auto both = opened(cardFacingDown(mirrored, true), "both.glb", bothSides);
    for (const char* technique :
         {"hard", "pcss-mip", "wedges", "wedges-blended", "wedges-cells", "shadow-volume"}) {
      const auto unseen = visibility(card, technique);
      EXPECT_LT(difference(unseen, visibility(hidden, technique)).shareOverEight, 0.003) << technique;
      EXPECT_GT(difference(unseen, visibility(both, technique)).shareOverEight, 0.02) << technique;
      EXPECT_GT(difference(unseen, unseen).shadow, 1.0) << technique << ": it casts";
    }
    // Rays see the floor through it, and its shadow there.
    const auto seen = reference::traceReceivers(card, *card.camera, card.lights.front(), kWidth, kHeight);
    ASSERT_TRUE(seen.ok());
    for (const glm::dvec3& place : seen->positionWorld) EXPECT_LT(std::abs(place.y), 1e-6);
    const std::vector<float> traced = truth(card);
    EXPECT_GT(std::ranges::count(traced, 0.0f), 100);
    // Where an engine's host mirrors, and not the file.
    scene::SceneDescription turned = card;
    turned.objects[1].worldFromObject =
        glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1)) * turned.objects[1].worldFromObject;
    EXPECT_LT(difference(visibility(turned, "hard"), visibility(card, "hard")).shareOverEight, 0.003);
    const auto turnedSeen =
        reference::traceReceivers(turned, *turned.camera, turned.lights.front(), kWidth, kHeight);
    ASSERT_TRUE(turnedSeen.ok());
    EXPECT_EQ(turnedSeen->kind, seen->kind);
  }
}

TEST_F(Twins, ASunsShadowsAreParallel) {
  // Posts of one height: the tips of their shadows lie as far from them everywhere.
  GltfWriter writer = posts(false);
  for (std::size_t i = 1; i < writer.json["nodes"].size(); ++i) writer.json["nodes"][i]["translation"][1] = 0;
  writer.json["extensions"] = {
      {"KHR_lights_punctual", {{"lights", Json::array({{{"type", "directional"}}})}}}};
  // Shines along (-1, -1, 0): its -z is turned there.
  const double c = std::cos(M_PI / 8), s = std::sin(M_PI / 8), h = std::sqrt(0.5);
  writer.json["nodes"].push_back({{"rotation", {-s * h, c * h, s * h, c * h}},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  showAll(writer);
  SceneOptions how = options();
  how.light.reset();
  const auto scene = opened(writer, "sun.glb", how);
  ASSERT_EQ(scene.lights.size(), 1u);
  const glm::dvec3 way = scene.lights[0].emission;
  for (const scene::SceneObject& object : scene.objects) {
    if (!object.casts) continue;
    const glm::dvec3 top(object.worldFromObject[3].x, 1.2, object.worldFromObject[3].z);
    const glm::dvec3 ray = glm::normalize(top - scene.lights[0].centerWorld);
    const glm::dvec3 tip = top + ray * (1.2 / -ray.y), straight = top + way * (1.2 / -way.y);
    EXPECT_LT(glm::length(tip - straight), 0.004) << "a five-hundredth of the shadow's length";
  }
  // And the techniques find them where truth does.
  const std::vector<float> traced = truth(scene);
  const auto receivers =
      reference::traceReceivers(scene, *scene.camera, scene.lights.front(), kWidth, kHeight);
  ASSERT_TRUE(receivers.ok());
  for (const char* technique : {"hard", "pcss-mip", "shadow-width", "occlusion-textures", "wedges-cells"}) {
    const auto bytes = visibility(scene, technique);
    double sum = 0.0, shadow = 0.0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (receivers->kind[i] == reference::kNoReceiver) continue;  // turned away from the light
      sum += std::abs(bytes[i] / 255.0 - traced[i]);
      shadow += 1.0 - traced[i];
    }
    EXPECT_GT(shadow, 100.0);
    EXPECT_LT(sum, 0.1 * shadow) << technique;
  }
}

}  // namespace
}  // namespace halfshadow::scenes
