// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Files as scenes: loaded, completed and judged.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "fuzz_target.hpp"
#include "gltf_seeds.hpp"
#include "scenes/gltf_loader.hpp"
#include "scenes/scene_source.hpp"
#include "scenes/validate.hpp"
#include "temporary_file.hpp"

namespace halfshadow::fuzz {
namespace {
bool isFinite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) return false;
    }
  }
  return true;
}

void checkMesh(const scene::TriangleMesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  require(!mesh.indices.empty() && mesh.indices.size() % 3 == 0, "a mesh holds no whole triangles");
  for (const std::uint32_t index : mesh.indices) require(index < vertices, "an index is out of range");
  for (const glm::vec3& p : mesh.positions)
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "a position is not finite");
  require(mesh.normals.empty() || mesh.normals.size() == vertices, "normals are not one a vertex");
  require(mesh.texcoords.empty() || mesh.texcoords.size() == vertices, "coordinates are not one a vertex");
  require(mesh.colors.empty() || mesh.colors.size() == vertices, "colours are not one a vertex");
}

void checkImage(const scene::Image& image) {
  require(image.width > 0 && image.height > 0 && (image.channels == 3 || image.channels == 4),
          "an image has no size");
  require(image.pixels.size() == static_cast<std::size_t>(image.width) *
                                     static_cast<std::size_t>(image.height) *
                                     static_cast<std::size_t>(image.channels),
          "an image holds more or less than its size says");
}

void checkScene(const scene::SceneDescription& scene) {
  require(!scene.objects.empty(), "a scene without objects is no error");
  for (const scene::SceneObject& object : scene.objects) {
    require(object.mesh != nullptr && isFinite(object.worldFromObject), "an object stands nowhere");
    checkMesh(*object.mesh);
    if (object.material.baseColorImage) checkImage(*object.material.baseColorImage);
  }
}

void test(Input input) {
  static const TemporaryFile file("input.glb");
  file.write(input);
  auto loaded = scenes::loadGltf(file.path(), {.animationTimeSeconds = 0.4});
  if (!loaded) {
    const Error& error = loaded.error();
    require(error.code == ErrorCode::fileMalformed || error.code == ErrorCode::emptyScene ||
                error.code == ErrorCode::invalidArgument,
            "an error of another kind: " + error.message);
    require(error.message.starts_with(file.path() + ": ") && error.message.size() > file.path().size() + 10,
            "an error without a sentence");
    return;
  }
  checkScene(*loaded);
  (void)scenes::validateScene(*loaded);
  const Status completed = scenes::completeScene(*loaded, {});
  if (!completed) {
    require(!completed.error().message.empty(), "an error without a sentence");
    return;
  }
  checkScene(*loaded);
  require(loaded->camera && scene::checkCamera(*loaded->camera).ok(), "a completed scene has no camera");
  require(!loaded->lights.empty(), "a completed scene has no light");
}

void append(Bytes& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

/// Puts the lengths of a .glb and of its chunks right.
void repair(Bytes& input) {
  constexpr std::size_t kHeader = 20;
  constexpr std::uint8_t kBinary[] = {'B', 'I', 'N', 0};
  if (input.size() < kHeader || std::memcmp(input.data(), "glTF", 4) != 0) return;
  const auto found =
      std::search(input.begin() + kHeader, input.end(), std::begin(kBinary), std::end(kBinary));
  const auto name = static_cast<std::size_t>(found - input.begin());
  const bool hasBinary = name < input.size() && name >= kHeader + 4;
  Bytes json(input.begin() + kHeader, hasBinary ? found - 4 : input.end());
  Bytes binary(hasBinary ? found + 4 : input.end(), input.end());
  while (json.size() % 4 != 0) json.push_back(' ');
  while (binary.size() % 4 != 0) binary.push_back(0);
  Bytes file = bytesOf("glTF");
  append(file, 2);
  append(file, static_cast<std::uint32_t>(kHeader + json.size() + (hasBinary ? 8 + binary.size() : 0)));
  append(file, static_cast<std::uint32_t>(json.size()));
  append(file, 0x4E4F534A);
  file.insert(file.end(), json.begin(), json.end());
  if (hasBinary) {
    append(file, static_cast<std::uint32_t>(binary.size()));
    append(file, 0x004E4942);
    file.insert(file.end(), binary.begin(), binary.end());
  }
  input = std::move(file);
}
}  // namespace

const Target& target() {
  static const Target made{.name = "gltf",
                           .test = test,
                           .seeds = gltfSeeds,
                           .dictionary = gltfWords,
                           .repair = repair,
                           .largestInput = 1 << 14};
  return made;
}

}  // namespace halfshadow::fuzz
