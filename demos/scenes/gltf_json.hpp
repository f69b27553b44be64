// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A glTF file's bytes and its JSON, before anything else of it is believed (internal).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace halfshadow::scenes {

using Json = nlohmann::json;
using FileBytes = std::vector<unsigned char>;

/// Errors name the element but not the file; loadGltf puts the file's name in front.
inline Error malformed(std::string sentence) {
  return {ErrorCode::fileMalformed, std::move(sentence)};
}

/// Errors: fileNotFound, fileMalformed (above 2 GiB).
Result<FileBytes> readWholeFile(const std::string& path);

/// .glb is recognised by its first bytes; everything else is taken as JSON text.
struct GltfDocument {
  Json json;
  bool isBinary = false;
  std::string_view text;    ///< of the JSON, in the file's bytes
  std::string_view binary;  ///< .glb's second chunk, in the file's bytes; may be empty
};
/// The document refers to `bytes`. Errors: fileMalformed.
Result<GltfDocument> documentOf(const FileBytes& bytes);

/// A .glb of this JSON and binary chunk.
FileBytes glbOf(const Json& json, std::string_view binary);

/// What stands under a key of an object; null where `json` is no object or has no such key.
const Json* memberOf(const Json& json, const char* key);
/// extensions.NAME of a glTF element, or null.
const Json* extensionOf(const Json& json, const char* name);
/// The elements of an array under a key; none where there is no array.
std::vector<Json*> elementsOf(Json& json, const char* key);
/// A whole number >= 0 under a key.
std::optional<std::uint64_t> countIn(const Json& json, const char* key);
/// The texts of an array under a key, at most 80 characters each.
std::vector<std::string> textsIn(const Json& json, const char* key);

}  // namespace halfshadow::scenes
