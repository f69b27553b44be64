// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_decode.hpp"

#include <algorithm>

#include "scenes/gltf_draco.hpp"
#include "scenes/gltf_meshopt.hpp"

namespace halfshadow::scenes {
namespace {
constexpr std::string_view kDraco = "KHR_draco_mesh_compression";

std::string withoutDecoder(std::string_view extension, const char* package) {
  return "it requires the extension '" + std::string(extension) +
         "', and this build has no decoder for it: install " + package +
         " and build again, or export the file uncompressed";
}
}  // namespace

std::string missingDecoder(std::string_view extension) {
  if (extension == kDraco && !kHasDraco) return withoutDecoder(extension, "libdraco-dev");
  if (isMeshoptExtension(extension) && !kHasMeshopt) return withoutDecoder(extension, "libmeshoptimizer-dev");
  return {};
}

ParserDetour takeDetour(Json& json, bool isBinary) {
  ParserDetour detour;
  const std::vector<Json*> buffers = elementsOf(json, "buffers");
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    if (!buffers[i]->is_object() || buffers[i]->contains("uri") || (isBinary && i == 0)) continue;
    if (meshoptOf(*buffers[i]) == nullptr) continue;
    (*buffers[i])["uri"] = "data:application/octet-stream;base64,AAAA";
    (*buffers[i])["byteLength"] = 3;
    detour.emptyBuffers.push_back(i);
  }
  const std::vector<Json*> accessors = elementsOf(json, "accessors");
  const bool hasViews = !elementsOf(json, "bufferViews").empty();
  for (Json* mesh : elementsOf(json, "meshes")) {
    for (Json* primitive : elementsOf(*mesh, "primitives")) {
      const auto index = countIn(*primitive, "indices");
      if (!index || *index >= accessors.size() || !hasViews || !accessors[*index]->is_object()) continue;
      if (accessors[*index]->contains("bufferView")) continue;
      (*accessors[*index])["bufferView"] = 0;
      detour.emptyAccessors.push_back(*index);
    }
  }
  // Channels without a node are what KHR_animation_pointer is for; the parser would drop them.
  for (Json* animation : elementsOf(json, "animations")) {
    for (Json* channel : elementsOf(*animation, "channels")) {
      if (memberOf(*channel, "target") == nullptr) continue;
      Json& target = (*channel)["target"];
      if (!target.is_object() || target.contains("node")) continue;
      target["node"] = -1;
      detour.namesTargets = true;
    }
  }
  return detour;
}

void undoDetour(const ParserDetour& detour, tinygltf::Model& model) {
  for (const std::size_t i : detour.emptyBuffers) {
    if (i < model.buffers.size()) model.buffers[i].data.clear();
  }
  for (const std::size_t i : detour.emptyAccessors) {
    if (i < model.accessors.size()) model.accessors[i].bufferView = -1;
  }
}

Status decodeGeometry(Json& json, tinygltf::Model& model) {
  if (Status status = decodeMeshopt(json, model); !status) return status;
  return decodeDraco(json, model);
}

}  // namespace halfshadow::scenes
