// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>
#include <vector>

namespace halfshadow::scenes {
namespace {
using Bytes = std::vector<unsigned char>;

Result<Bytes> readFile(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return Error{ErrorCode::fileNotFound, "there is no such file; check the path, or use builtin:NAME"};
  }
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0) return Error{ErrorCode::fileNotFound, "the file cannot be read; check its permissions"};
  if (size > std::numeric_limits<std::int32_t>::max()) {
    return malformed("the file is larger than 2 GiB; split it");
  }
  Bytes bytes(static_cast<std::size_t>(size));
  stream.seekg(0);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), size)) {
    return Error{ErrorCode::fileNotFound, "the file cannot be read to its end; check the disk"};
  }
  return bytes;
}

std::uint32_t littleEndian32(const Bytes& bytes, std::size_t at) {
  return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

/// The JSON chunk of a .glb whose header and chunk lengths are consistent with the file's size.
Result<std::string_view> jsonOfBinary(const Bytes& bytes) {
  if (bytes.size() < 20) return malformed("the file ends inside its .glb header; copy or export it again");
  if (littleEndian32(bytes, 4) != 2) {
    return malformed(".glb version " + std::to_string(littleEndian32(bytes, 4)) +
                     " is not supported; export glTF 2.0");
  }
  const std::size_t length = littleEndian32(bytes, 8), jsonLength = littleEndian32(bytes, 12);
  if (length > bytes.size()) {
    return malformed("the header promises " + std::to_string(length) + " bytes but the file has " +
                     std::to_string(bytes.size()) + ": it is truncated; copy or export it again");
  }
  if (littleEndian32(bytes, 16) != 0x4E4F534A || jsonLength == 0 || 20 + jsonLength > length) {
    return malformed("the first chunk of the .glb is not JSON that fits into the file; export it again");
  }
  std::size_t at = 20 + jsonLength;
  if (at != length) {
    if (at + 8 > length || at + 8 + littleEndian32(bytes, at) > length) {
      return malformed("the binary chunk of the .glb overruns the file; copy or export it again");
    }
  }
  return std::string_view(reinterpret_cast<const char*>(bytes.data()) + 20, jsonLength);
}

/// tinygltf descends recursively into extras: without a limit, nested brackets would exhaust the stack.
bool isTooDeep(std::string_view json) {
  constexpr int kDeepest = 200;
  int depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepest) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

/// tinygltf hands over image bytes in buffer views without checking their range, so those are not touched
/// here. Always succeeds: an image that cannot be decoded keeps width -1 and becomes a note.
bool decodeImageFromUri(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
                        const unsigned char* bytes, int size, void*) {
  if (image->bufferView != -1) return true;
  std::string error, warning;
  if (!tinygltf::LoadImageData(image, index, &error, &warning, 0, 0, bytes, size, nullptr)) image->width = -1;
  return true;
}

std::string firstLine(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "it does not follow the glTF 2.0 schema" : line.substr(0, 300);
}

Status checkExtensions(const tinygltf::Model& model) {
  // Materials and textures change nothing that shadows need; quantised attributes are read like any others.
  constexpr std::array<std::string_view, 2> kKnown = {"KHR_lights_punctual", "KHR_mesh_quantization"};
  for (const std::string& name : model.extensionsRequired) {
    if (std::find(kKnown.begin(), kKnown.end(), name) == kKnown.end() &&
        !name.starts_with("KHR_materials_") && name.find("_texture_") == std::string::npos) {
      return malformed("it requires the extension '" + name.substr(0, 80) + "'; export it without that");
    }
  }
  return {};
}
}  // namespace

Result<tinygltf::Model> parseGltfFile(const std::string& path) {
  Result<Bytes> bytes = readFile(path);
  if (!bytes) return bytes.error();
  const bool isBinary = bytes->size() >= 4 && std::memcmp(bytes->data(), "glTF", 4) == 0;
  std::string_view json(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  if (isBinary) {
    const Result<std::string_view> chunk = jsonOfBinary(*bytes);
    if (!chunk) return chunk.error();
    json = *chunk;
  }
  if (json.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return malformed("the file is empty; export it again");
  }
  if (isTooDeep(json)) return malformed("its JSON is nested more than 200 levels deep; flatten its extras");

  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(decodeImageFromUri, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  bool parsed = false;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const auto size = static_cast<unsigned int>(bytes->size());
  try {  // tinygltf and its JSON library throw on some wrong types and on absurd sizes
    parsed = isBinary ? parser.LoadBinaryFromMemory(&model, &error, &warning, bytes->data(), size, folder)
                      : parser.LoadASCIIFromString(&model, &error, &warning, json.data(), size, folder);
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!parsed)
    return malformed("it is not a readable glTF 2.0 file (" + firstLine(error) + "); export it again");
  if (Status status = checkExtensions(model); !status) return status.error();
  return model;
}

}  // namespace halfshadow::scenes
