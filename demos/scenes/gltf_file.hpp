// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Reads a glTF file into tinygltf's model, guarded against what tinygltf itself trusts (internal).
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "scenes/gltf_json.hpp"

namespace halfshadow::scenes {

struct GltfFile {
  tinygltf::Model model;
  std::vector<std::string> notes;  ///< extensions that are not honoured
};

/// Parses .glb or .gltf with its buffers, geometry decompressed. Images keep their encoded bytes: those that
/// come by URI in Image::image, with width -1; others in their buffer views.
Result<GltfFile> parseGltfFile(const std::string& path);

}  // namespace halfshadow::scenes
