// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <random>

#include "gltf_writer.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::scenes {
namespace {
using testing::GltfWriter;
using testing::Json;
using testing::quadWriter;

struct Damage {
  const char* name;
  std::function<void(GltfWriter&)> apply;
  ErrorCode code;
  const char* mentions;  ///< a part of the message that names the culprit
};

void PrintTo(const Damage& damage, std::ostream* out) {
  *out << damage.name;
}

class MalformedGltf : public ::testing::TestWithParam<Damage> {};

TEST_P(MalformedGltf, IsOneClearError) {
  GltfWriter writer = quadWriter();
  GetParam().apply(writer);
  const auto result = writer.load();
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, GetParam().code) << result.error().message;
  EXPECT_NE(result.error().message.find("file.glb: "), std::string::npos) << result.error().message;
  EXPECT_NE(result.error().message.find(GetParam().mentions), std::string::npos) << result.error().message;
}

void setIndices(GltfWriter& w, const std::vector<std::uint16_t>& indices) {
  w.primitive()["indices"] = w.addAccessor(indices, testing::kUnsignedShort, "SCALAR", 1);
}

void setPositions(GltfWriter& w, const std::vector<float>& positions) {
  w.primitive()["attributes"]["POSITION"] = w.addAccessor(positions, testing::kFloat, "VEC3", 3);
}

const float kNan = std::numeric_limits<float>::quiet_NaN(),
            kInfinity = std::numeric_limits<float>::infinity();
constexpr ErrorCode kMalformed = ErrorCode::fileMalformed;

const Damage kDamages[] = {
    {"IndexOutOfRange",
     [](auto& w) {
       setIndices(w, {0, 1, 4});
     },
     kMalformed, "index 2"},
    {"IndexCountNotThrice",
     [](auto& w) {
       setIndices(w, {0, 1, 2, 3});
     },
     kMalformed, "multiple of 3"},
    {"FloatIndices",
     [](auto& w) {
       w.primitive()["indices"] = w.addAccessor(std::vector<float>{0, 1, 2}, testing::kFloat, "SCALAR", 1);
     },
     kMalformed, "indices"},
    {"MissingIndexAccessor", [](auto& w) { w.primitive()["indices"] = 77; }, kMalformed, "ccessor"},
    {"NoPosition",
     [](auto& w) {
       w.primitive()["attributes"] = {{"NORMAL", 0}};
     },
     kMalformed, "POSITION"},
    {"MissingPositionAccessor", [](auto& w) { w.primitive()["attributes"]["POSITION"] = 9; }, kMalformed,
     "POSITION"},
    {"NegativePositionAccessor", [](auto& w) { w.primitive()["attributes"]["POSITION"] = -3; }, kMalformed,
     "POSITION"},
    {"PositionOfWrongType", [](auto& w) { w.json["accessors"][0]["type"] = "VEC2"; }, kMalformed, "POSITION"},
    {"PositionNaN",
     [](auto& w) {
       setPositions(w, {0, 0, 0, 1, kNan, 0, 0, 1, 0, 1, 1, 0});
     },
     kMalformed, "element 1"},
    {"PositionInfinite",
     [](auto& w) {
       setPositions(w, {0, 0, 0, 1, 0, 0, 0, kInfinity, 0, 1, 1, 0});
     },
     kMalformed, "element 2"},
    {"AccessorOverrun", [](auto& w) { w.json["accessors"][0]["count"] = 5; }, kMalformed, "overrun"},
    {"AccessorCountHuge", [](auto& w) { w.json["accessors"][0]["count"] = 4000000000u; }, kMalformed,
     "accessor 0"},
    {"ElementsWithoutBytes",
     [](auto& w) {
       w.json["accessors"][0].erase("bufferView");
       w.json["accessors"][0]["count"] = 60000000;
     },
     kMalformed, "no buffer view"},
    {"AccessorOffsetOverrun", [](auto& w) { w.json["accessors"][0]["byteOffset"] = 4; }, kMalformed,
     "overrun"},
    {"AccessorViewMissing", [](auto& w) { w.json["accessors"][0]["bufferView"] = 12; }, kMalformed,
     "buffer view 12"},
    {"ViewOverrun", [](auto& w) { w.json["bufferViews"][0]["byteLength"] = 100000; }, kMalformed, "overrun"},
    {"ViewOffsetOverrun", [](auto& w) { w.json["bufferViews"][0]["byteOffset"] = 4294967295u; }, kMalformed,
     "overrun"},
    {"ViewBufferMissing", [](auto& w) { w.json["bufferViews"][0]["buffer"] = 3; }, kMalformed, "buffer 3"},
    {"StrideTooSmall", [](auto& w) { w.json["bufferViews"][0]["byteStride"] = 4; }, kMalformed, "stride"},
    {"SparseIndexOutOfRange",
     [](auto& w) {
       const int indices = w.addView(std::vector<std::uint8_t>{200}),
                 values = w.addView(std::vector<float>{1, 2, 3});
       w.json["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", values}}}};
     },
     kMalformed, "sparse"},
    {"NormalCountMismatch",
     [](auto& w) {
       w.primitive()["attributes"]["NORMAL"] =
           w.addAccessor(std::vector<float>{0, 0, 1}, testing::kFloat, "VEC3", 3);
     },
     kMalformed, "NORMAL"},
    {"UnknownMode", [](auto& w) { w.primitive()["mode"] = 9; }, kMalformed, "mode"},
    {"MaterialMissing", [](auto& w) { w.primitive()["material"] = 2; }, kMalformed, "material 2"},
    {"MeshMissing", [](auto& w) { w.json["nodes"][0]["mesh"] = 5; }, kMalformed, "mesh 5"},
    {"SkinMissing", [](auto& w) { w.json["nodes"][0]["skin"] = 5; }, kMalformed, "skin 5"},
    {"CameraMissing", [](auto& w) { w.json["nodes"][0]["camera"] = 5; }, kMalformed, "camera 5"},
    {"SkinWithoutJoints",
     [](auto& w) {
       w.json["skins"] = Json::array({{{"joints", {0}}}});
       w.json["nodes"][0]["skin"] = 0;
     },
     kMalformed, "JOINTS_0"},
    {"ChildMissing", [](auto& w) { w.json["nodes"][0]["children"] = {8}; }, kMalformed, "child 8"},
    {"OwnChild", [](auto& w) { w.json["nodes"][0]["children"] = {0}; }, kMalformed, "cycle"},
    {"Cycle",
     [](auto& w) {
       w.json["nodes"] = Json::array({{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}});
     },
     kMalformed, "cycle"},
    {"TwoParents",
     [](auto& w) {
       w.json["nodes"] = Json::array({{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}});
     },
     kMalformed, "two nodes"},
    {"SceneNodeMissing", [](auto& w) { w.json["scenes"][0]["nodes"] = {6}; }, kMalformed, "node 6"},
    {"DefaultSceneMissing", [](auto& w) { w.json["scene"] = 6; }, kMalformed, "scene 6"},
    {"SingularMatrix",
     [](auto& w) { w.json["nodes"][0]["matrix"] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}; },
     ErrorCode::emptyScene, "no triangles"},
    {"ShortMatrix",
     [](auto& w) {
       w.json["nodes"][0]["matrix"] = {1, 0, 0};
     },
     kMalformed, "16 numbers"},
    {"ZeroRotation",
     [](auto& w) {
       w.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     kMalformed, "rotation"},
    {"OverflowingScale",
     [](auto& w) {
       w.json["nodes"] = Json::array(
           {{{"scale", {1e300, 1, 1}}, {"children", {1}}}, {{"mesh", 0}, {"scale", {1e300, 1, 1}}}});
     },
     kMalformed, "node 1"},
    {"RequiredExtension", [](auto& w) { w.json["extensionsRequired"] = {"EXT_unheard_of"}; }, kMalformed,
     "EXT_unheard_of"},
    {"LightMissing",
     [](auto& w) {
       w.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 3}}}};
     },
     kMalformed, "light"},
    {"LightBeyondInt",
     [](auto& w) {
       w.json["extensions"] = {{"KHR_lights_punctual", {{"lights", Json::array({{{"type", "point"}}})}}}};
       w.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 4e9}}}};
     },
     kMalformed, "light"},
    {"LightBetweenTwo",
     [](auto& w) {
       w.json["extensions"] = {{"KHR_lights_punctual", {{"lights", Json::array({{{"type", "point"}}})}}}};
       w.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0.5}}}};
     },
     kMalformed, "light"},
    {"LightSizeNegative",
     [](auto& w) {
       w.json["extensions"] = {{"KHR_lights_punctual", {{"lights", Json::array({{{"type", "point"}}})}}}};
       w.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
       w.json["nodes"][0]["extras"] = {{"halfshadow", {{"size", -1}}}};
     },
     kMalformed, "size"},
    {"AnimationNodeMissing",
     [](auto& w) {
       w.json["animations"] = Json::array(
           {{{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 4}, {"path", "scale"}}}}})},
             {"samplers", Json::array({{{"input", 0}, {"output", 0}}})}}});
     },
     kMalformed, "node 4"},
    {"AnimationCountMismatch",
     [](auto& w) {
       const int times = w.addAccessor(std::vector<float>{0, 1, 2}, testing::kFloat, "SCALAR", 1);
       w.json["animations"] = Json::array(
           {{{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}})},
             {"samplers", Json::array({{{"input", times}, {"output", 0}}})}}});
     },
     kMalformed, "channel 0"},
    {"AccessorsNotAnArrayOfObjects",
     [](auto& w) {
       w.json["accessors"] = {1, 2};
     },
     kMalformed, "accessors"},
    {"DeepExtras",
     [](auto& w) {
       Json nested = 1;
       for (int i = 0; i < 500; ++i) nested = Json::array({nested});
       w.json["extras"] = nested;
     },
     kMalformed, "nested"},
    {"PointsOnly", [](auto& w) { w.primitive()["mode"] = 0; }, ErrorCode::emptyScene, "no triangles"},
    {"NoMeshInScene", [](auto& w) { w.json["nodes"][0].erase("mesh"); }, ErrorCode::emptyScene,
     "no triangles"},
    {"OnlyDegenerate",
     [](auto& w) {
       setIndices(w, {0, 0, 1});
     },
     ErrorCode::emptyScene, "no triangles"},
};

INSTANTIATE_TEST_SUITE_P(Gltf, MalformedGltf, ::testing::ValuesIn(kDamages),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(MalformedGltfFile, Missing) {
  const auto result = loadGltf(::testing::TempDir() + "halfshadow_no_such_file.glb", {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::fileNotFound);
  const auto folder = loadGltf(::testing::TempDir(), {});
  ASSERT_FALSE(folder.ok());
  EXPECT_EQ(folder.error().code, ErrorCode::fileNotFound);
}

TEST(MalformedGltfFile, EveryTruncationIsAnError) {
  const std::string whole = quadWriter().glb();
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    const auto result = GltfWriter::loadBytes(whole.substr(0, length));
    ASSERT_FALSE(result.ok()) << length << " bytes of " << whole.size();
    EXPECT_EQ(result.error().code, ErrorCode::fileMalformed) << result.error().message;
  }
}

TEST(MalformedGltfFile, NotJson) {
  for (const char* content :
       {"", "   ", "hello", "{", "[]", "{\"asset\": 3}", "null", "{\"asset\":{\"version\":\"2.0\"}}"}) {
    const auto result = GltfWriter::loadBytes(content);
    ASSERT_FALSE(result.ok()) << content;
    EXPECT_TRUE(result.error().code == ErrorCode::fileMalformed ||
                result.error().code == ErrorCode::emptyScene);
  }
}

TEST(MalformedGltfFile, MissingExternalBuffer) {
  GltfWriter writer = quadWriter();
  writer.json["buffers"] = Json::array({{{"byteLength", 100}, {"uri", "no_such_buffer.bin"}}});
  const auto result = loadGltf(GltfWriter::writeFile("scene.gltf", writer.json.dump()), {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::fileMalformed);
}

/// A file with every feature, so that damage can reach every reader.
std::string richFile() {
  GltfWriter w = quadWriter();
  w.primitive()["attributes"]["JOINTS_0"] =
      w.addAccessor(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0},
                    testing::kUnsignedByte, "VEC4", 4);
  w.primitive()["attributes"]["WEIGHTS_0"] = w.addAccessor(
      std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, .5f, .5f, 0, 0, 1, 0, 0, 0}, testing::kFloat, "VEC4", 4);
  w.primitive()["attributes"]["TEXCOORD_0"] =
      w.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, testing::kFloat, "VEC2", 2);
  const int offsets =
      w.addAccessor(std::vector<float>{0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0}, testing::kFloat, "VEC3", 3);
  w.primitive()["targets"] = Json::array({{{"POSITION", offsets}}});
  w.primitive()["material"] = 0;
  w.json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  w.json["textures"] = Json::array({{{"source", 0}}});
  w.json["images"] = Json::array({{{"bufferView", 1}, {"mimeType", "image/png"}}});
  const int times = w.addAccessor(std::vector<float>{0, 1}, testing::kFloat, "SCALAR", 1);
  const int moves = w.addAccessor(std::vector<float>{0, 0, 0, 1, 1, 1}, testing::kFloat, "VEC3", 3);
  w.json["animations"] = Json::array(
      {{{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}})},
        {"samplers", Json::array({{{"input", times}, {"output", moves}}})}}});
  w.json["skins"] = Json::array({{{"joints", {1, 2}}}});
  w.json["cameras"] =
      Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}});
  w.json["extensions"] = {{"KHR_lights_punctual", {{"lights", Json::array({{{"type", "directional"}}})}}}};
  w.json["nodes"] = Json::array({{{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}},
                                 {{"children", {2}},
                                  {"extras", {{"halfshadow", {{"casts", true}, {"size", {1, 1}}}}}},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
                                 {{"camera", 0}, {"rotation", {0, 0, 0, 1}}}});
  w.json["scenes"][0]["nodes"] = {0, 1};
  return w.glb();
}

TEST(MalformedGltfFile, TheFuzzersSeedIsValid) {
  const auto result = GltfWriter::loadBytes(richFile());
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_EQ(result->lights.size(), 1u);
  EXPECT_TRUE(result->camera.has_value());
}

TEST(MalformedGltfFile, RandomDamageNeverCrashesAndWhatLoadsIsUsable) {
  const std::string seed = richFile();
  std::mt19937 random(20260701);  // fixed: a failure can be repeated
  const auto below = [&](std::size_t bound) { return static_cast<std::size_t>(random() % bound); };
  int loadedCount = 0;
  for (int round = 0; round < 2000; ++round) {
    std::string damaged = seed;
    const std::size_t edits = 1 + below(4);
    for (std::size_t edit = 0; edit < edits; ++edit) {
      const std::size_t at = below(damaged.size());
      switch (below(4)) {
        case 0:
          damaged[at] = static_cast<char>(below(256));
          break;
        case 1:
          damaged[at] = "0123456789-[]{},:\"e"[below(19)];
          break;  // stays nearly JSON
        case 2:
          damaged[at] ^= static_cast<char>(1 << below(8));
          break;
        default:
          if (below(8) == 0) damaged.resize(at + 1);
      }
    }
    const auto result = GltfWriter::loadBytes(damaged, {.animationTimeSeconds = 0.5});
    if (!result.ok()) {
      EXPECT_FALSE(result.error().message.empty());
      continue;
    }
    ++loadedCount;
    scene::SceneDescription description = *result;
    // Completing may refuse (a camera at the objects' only point), but must not crash either.
    (void)completeScene(description, {}).ok();
    for (const scene::SceneObject& object : description.objects) {
      for (const std::uint32_t index : object.mesh->indices) ASSERT_LT(index, object.mesh->positions.size());
    }
  }
  EXPECT_GT(loadedCount, 20) << "damage that always breaks the JSON tests only the JSON parser";
}

}  // namespace
}  // namespace halfshadow::scenes
