// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Compressed geometry of glTF files (internal).
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <string_view>
#include <vector>

#include "scenes/gltf_json.hpp"

namespace halfshadow::scenes {

/// A sentence where this is a compression that this build cannot decode; else empty.
std::string missingDecoder(std::string_view extension);

/// What the parser refuses though the format allows it, made acceptable in `json`, and put right afterwards.
struct ParserDetour {
  std::vector<std::size_t> emptyBuffers;    ///< without bytes in the file: filled by decoding
  std::vector<std::size_t> emptyAccessors;  ///< of indices, without a buffer view
  bool namesTargets = false;                ///< of animation channels without a node
  bool isNeeded() const { return !emptyBuffers.empty() || !emptyAccessors.empty() || namesTargets; }
};
ParserDetour takeDetour(Json& json, bool isBinary);
void undoDetour(const ParserDetour& detour, tinygltf::Model& model);

/// Replaces buffer views under EXT_meshopt_compression and primitives under KHR_draco_mesh_compression by
/// plain ones. `json` is the file's. Errors: fileMalformed, with the extension's name.
Status decodeGeometry(Json& json, tinygltf::Model& model);

}  // namespace halfshadow::scenes
