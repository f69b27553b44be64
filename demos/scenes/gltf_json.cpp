// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_json.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

namespace halfshadow::scenes {
namespace {
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

std::uint32_t littleEndian32(const FileBytes& bytes, std::size_t at) {
  return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

std::string_view part(const FileBytes& bytes, std::size_t at, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes.data()) + at, size};
}

/// The chunks of a .glb whose header and chunk lengths are consistent with the file's size.
Status findChunks(const FileBytes& bytes, GltfDocument& document) {
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
  if (littleEndian32(bytes, 16) != kJsonChunk || jsonLength == 0 || 20 + jsonLength > length) {
    return malformed("the first chunk of the .glb is not JSON that fits into the file; export it again");
  }
  document.text = part(bytes, 20, jsonLength);
  const std::size_t at = 20 + jsonLength;
  if (at == length) return {};
  if (at + 8 > length || at + 8 + littleEndian32(bytes, at) > length) {
    return malformed("the binary chunk of the .glb overruns the file; copy or export it again");
  }
  if (littleEndian32(bytes, at + 4) == kBinaryChunk)
    document.binary = part(bytes, at + 8, littleEndian32(bytes, at));
  return {};
}

/// Parsers descend recursively: without a limit, nested brackets would exhaust the stack.
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
}  // namespace

Result<FileBytes> readWholeFile(const std::string& path) {
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
  FileBytes bytes(static_cast<std::size_t>(size));
  stream.seekg(0);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), size)) {
    return Error{ErrorCode::fileNotFound, "the file cannot be read to its end; check the disk"};
  }
  return bytes;
}

Result<GltfDocument> documentOf(const FileBytes& bytes) {
  GltfDocument document;
  document.isBinary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
  document.text = part(bytes, 0, bytes.size());
  if (document.isBinary) {
    if (Status status = findChunks(bytes, document); !status) return status.error();
  }
  if (document.text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return malformed("the file is empty; export it again");
  }
  if (isTooDeep(document.text)) {
    return malformed("its JSON is nested more than 200 levels deep; flatten its extras");
  }
  // Some exporters pad the chunk with zeros instead of spaces.
  if (const std::size_t end = document.text.find_last_not_of('\0'); end != std::string_view::npos)
    document.text = document.text.substr(0, end + 1);
  document.json = Json::parse(document.text, nullptr, false);
  if (!document.json.is_object()) {
    return malformed("it is not a readable glTF 2.0 file (its JSON cannot be parsed); export it again");
  }
  return document;
}

FileBytes glbOf(const Json& json, std::string_view binary) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  while (text.size() % 4 != 0) text += ' ';
  const std::size_t padding = (4 - binary.size() % 4) % 4;
  FileBytes bytes;
  bytes.reserve(28 + text.size() + binary.size() + padding);
  const auto append32 = [&](std::size_t value) {
    for (int byte = 0; byte < 4; ++byte)
      bytes.push_back(static_cast<unsigned char>(value >> (8 * byte) & 255));
  };
  append32(0x46546C67);
  append32(2);
  append32(20 + text.size() + (binary.empty() ? 0 : 8 + binary.size() + padding));
  append32(text.size());
  append32(kJsonChunk);
  bytes.insert(bytes.end(), text.begin(), text.end());
  if (binary.empty()) return bytes;
  append32(binary.size() + padding);
  append32(kBinaryChunk);
  bytes.insert(bytes.end(), binary.begin(), binary.end());
  bytes.insert(bytes.end(), padding, 0);
  return bytes;
}

const Json* memberOf(const Json& json, const char* key) {
  if (!json.is_object()) return nullptr;
  const auto found = json.find(key);
  return found == json.end() ? nullptr : &*found;
}

const Json* extensionOf(const Json& json, const char* name) {
  const Json* extensions = memberOf(json, "extensions");
  return extensions == nullptr ? nullptr : memberOf(*extensions, name);
}

std::vector<Json*> elementsOf(Json& json, const char* key) {
  std::vector<Json*> elements;
  if (!json.is_object()) return elements;
  const auto found = json.find(key);
  if (found == json.end() || !found->is_array()) return elements;
  for (Json& element : *found) elements.push_back(&element);
  return elements;
}

std::optional<std::uint64_t> countIn(const Json& json, const char* key) {
  const Json* number = memberOf(json, key);
  if (number == nullptr || !number->is_number_unsigned()) return std::nullopt;
  return number->get<std::uint64_t>();
}

std::vector<std::string> textsIn(const Json& json, const char* key) {
  std::vector<std::string> texts;
  const Json* array = memberOf(json, key);
  if (array == nullptr || !array->is_array()) return texts;
  for (const Json& element : *array) {
    if (element.is_string()) texts.push_back(element.get_ref<const std::string&>().substr(0, 80));
  }
  return texts;
}

}  // namespace halfshadow::scenes
