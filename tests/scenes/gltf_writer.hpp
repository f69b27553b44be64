// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Small glTF files, valid or broken on purpose, for the loader's tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/gltf_loader.hpp"

namespace halfshadow::scenes::testing {

using Json = nlohmann::json;

enum ComponentType {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};

class GltfWriter {
 public:
  GltfWriter() {
    json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", Json::array({{{"nodes", {0}}}})}};
    json["nodes"] = Json::array({{{"mesh", 0}}});
    json["accessors"] = json["bufferViews"] = Json::array();
    json["meshes"] = Json::array({{{"primitives", Json::array()}}});
  }

  Json json;
  std::vector<unsigned char> bytes;
  std::vector<Json> furtherBuffers;  ///< behind the one of `bytes`

  template <typename T>
  int addView(const std::vector<T>& values, int stride = 0) {
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (stride != 0) view["byteStride"] = stride;
    const auto* first = reinterpret_cast<const unsigned char*>(values.data());
    bytes.insert(bytes.end(), first, first + values.size() * sizeof(T));
    json["bufferViews"].push_back(view);
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  int addAccessor(const Json& accessor) {
    json["accessors"].push_back(accessor);
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  template <typename T>
  int addAccessor(const std::vector<T>& values, ComponentType componentType, const char* type,
                  std::size_t components) {
    return addAccessor({{"bufferView", addView(values)},
                        {"componentType", componentType},
                        {"count", values.size() / components},
                        {"type", type}});
  }

  Json& addPrimitive(const Json& primitive) {
    json["meshes"][0]["primitives"].push_back(primitive);
    return json["meshes"][0]["primitives"].back();
  }

  Json& primitive(std::size_t index = 0) { return json["meshes"][0]["primitives"][index]; }

  /// The .glb as bytes; `buffers` is added here.
  std::string glb() const {
    Json complete = json;
    std::vector<unsigned char> padded = bytes;
    while (padded.size() % 4 != 0) padded.push_back(0);
    if (!padded.empty()) complete["buffers"] = Json::array({{{"byteLength", padded.size()}}});
    for (const Json& buffer : furtherBuffers) complete["buffers"].push_back(buffer);
    std::string text = complete.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string file = "glTF";
    const auto append32 = [&](std::size_t value) {
      for (int byte = 0; byte < 4; ++byte) file += static_cast<char>(value >> (8 * byte) & 255);
    };
    append32(2);
    append32(20 + text.size() + (padded.empty() ? 0 : 8 + padded.size()));
    append32(text.size());
    append32(0x4E4F534A);
    file += text;
    if (!padded.empty()) {
      append32(padded.size());
      append32(0x004E4942);
      file.append(padded.begin(), padded.end());
    }
    return file;
  }

  Result<scene::SceneDescription> load(const GltfOptions& options = {}) const {
    return loadBytes(glb(), options);
  }

  static std::string writeFile(const std::string& name, std::string_view content) {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string unique = std::string(test->test_suite_name()) + "_" + test->name() + "_" + name;
    std::replace(unique.begin(), unique.end(), '/', '_');  // parameterised tests have slashes in their names
    const std::string path = ::testing::TempDir() + "halfshadow_" + unique;
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  static Result<scene::SceneDescription> loadBytes(std::string_view content,
                                                   const GltfOptions& options = {}) {
    return loadGltf(writeFile("file.glb", content), options);
  }
};

/// Two triangles: (0,0,0) (1,0,0) (0,1,0) and (1,0,0) (1,1,0) (0,1,0), indexed with 16 bits.
inline GltfWriter quadWriter() {
  GltfWriter writer;
  const int position =
      writer.addAccessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, kFloat, "VEC3", 3);
  const int indices =
      writer.addAccessor(std::vector<std::uint16_t>{0, 1, 2, 1, 3, 2}, kUnsignedShort, "SCALAR", 1);
  writer.addPrimitive({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  return writer;
}

/// Sum of the triangles' normals times area: orientation and extent in one vector.
inline glm::dvec3 areaVector(const scene::SceneObject& object) {
  const scene::TriangleMesh& mesh = *object.mesh;
  const auto at = [&](std::size_t i) {
    return glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i]]), 1.0));
  };
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    sum += glm::cross(at(i + 1) - at(i), at(i + 2) - at(i)) * 0.5;
  return sum;
}

inline bool anyNoteContains(const scene::SceneDescription& description, std::string_view words) {
  for (const std::string& note : description.notes) {
    if (note.find(words) != std::string::npos) return true;
  }
  return false;
}

}  // namespace halfshadow::scenes::testing
