// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Reads a glTF file into tinygltf's model, guarded against what tinygltf itself trusts (internal).
#pragma once

#include <tiny_gltf.h>

#include <string>

#include "base/error.hpp"

namespace halfshadow::scenes {

/// Errors name the element but not the file; loadGltf puts the file's name in front.
inline Error malformed(std::string sentence) {
  return {ErrorCode::fileMalformed, std::move(sentence)};
}

/// Parses .glb (recognised by its first bytes) or .gltf with its buffers. Images that come by URI are
/// decoded, images in buffer views are left to materialsOf, which checks their bounds.
Result<tinygltf::Model> parseGltfFile(const std::string& path);

}  // namespace halfshadow::scenes
