// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_meshopt.hpp"

#include <array>

#ifdef HALFSHADOW_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace halfshadow::scenes {
namespace {
constexpr std::array<const char*, 2> kNames = {"EXT_meshopt_compression", "KHR_meshopt_compression"};
}  // namespace

bool isMeshoptExtension(std::string_view name) {
  return name == kNames[0] || name == kNames[1];
}

const Json* meshoptOf(const Json& element) {
  for (const char* name : kNames) {
    if (const Json* found = extensionOf(element, name)) return found;
  }
  return nullptr;
}

#ifdef HALFSHADOW_HAS_MESHOPT
namespace {
struct Encoded {
  const unsigned char* bytes = nullptr;
  std::size_t byteCount = 0, count = 0, stride = 0;
  std::string mode, filter;
};

std::string textOf(const Json& object, const char* key, const char* otherwise) {
  const Json* text = memberOf(object, key);
  return text != nullptr && text->is_string() ? text->get<std::string>() : otherwise;
}

/// Nothing where a range or a number does not fit.
std::optional<Encoded> encodedOf(const Json& extension, const tinygltf::Model& model) {
  const auto buffer = countIn(extension, "buffer"), length = countIn(extension, "byteLength"),
             count = countIn(extension, "count"), stride = countIn(extension, "byteStride");
  const std::uint64_t offset = countIn(extension, "byteOffset").value_or(0);
  if (!buffer || !length || !count || !stride || *buffer >= model.buffers.size()) return std::nullopt;
  const std::vector<unsigned char>& bytes = model.buffers[*buffer].data;
  if (offset > bytes.size() || *length > bytes.size() - offset) return std::nullopt;
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 31;
  if (*stride == 0 || *stride > 256 || *count > kMostBytes / *stride) return std::nullopt;
  // The densest codes are two bits for 256 vertices of a byte each: more would be asked for in vain.
  constexpr std::uint64_t kMostBytesOfOne = 2048;
  if (*count * *stride > kMostBytesOfOne * *length) return std::nullopt;
  return Encoded{.bytes = bytes.data() + offset,
                 .byteCount = *length,
                 .count = *count,
                 .stride = *stride,
                 .mode = textOf(extension, "mode", ""),
                 .filter = textOf(extension, "filter", "NONE")};
}

bool filterInPlace(const Encoded& encoded, std::vector<unsigned char>& decoded) {
  if (encoded.filter == "NONE") return true;
  if (encoded.filter == "OCTAHEDRAL" && (encoded.stride == 4 || encoded.stride == 8)) {
    meshopt_decodeFilterOct(decoded.data(), encoded.count, encoded.stride);
  } else if (encoded.filter == "QUATERNION" && encoded.stride == 8) {
    meshopt_decodeFilterQuat(decoded.data(), encoded.count, encoded.stride);
  } else if (encoded.filter == "EXPONENTIAL" && encoded.stride % 4 == 0) {
    meshopt_decodeFilterExp(decoded.data(), encoded.count, encoded.stride);
  } else {
    return false;
  }
  return true;
}

bool decode(const Encoded& encoded, std::vector<unsigned char>& decoded) {
  decoded.resize(encoded.count * encoded.stride);
  const bool isIndex = encoded.stride == 2 || encoded.stride == 4;
  if (encoded.mode == "ATTRIBUTES" && encoded.stride % 4 == 0) {
    return meshopt_decodeVertexBuffer(decoded.data(), encoded.count, encoded.stride, encoded.bytes,
                                      encoded.byteCount) == 0 &&
           filterInPlace(encoded, decoded);
  }
  if (encoded.mode == "TRIANGLES" && isIndex && encoded.count % 3 == 0) {
    return meshopt_decodeIndexBuffer(decoded.data(), encoded.count, encoded.stride, encoded.bytes,
                                     encoded.byteCount) == 0;
  }
  if (encoded.mode == "INDICES" && isIndex) {
    return meshopt_decodeIndexSequence(decoded.data(), encoded.count, encoded.stride, encoded.bytes,
                                       encoded.byteCount) == 0;
  }
  return false;
}
}  // namespace

Status decodeMeshopt(Json& json, tinygltf::Model& model) {
  const std::vector<Json*> views = elementsOf(json, "bufferViews");
  for (std::size_t i = 0; i < views.size() && i < model.bufferViews.size(); ++i) {
    const Json* extension = meshoptOf(*views[i]);
    if (extension == nullptr) continue;
    const std::optional<Encoded> encoded = encodedOf(*extension, model);
    tinygltf::Buffer buffer;
    if (!encoded || !decode(*encoded, buffer.data)) {
      return malformed("the data of buffer view " + std::to_string(i) +
                       " under EXT_meshopt_compression cannot be decoded (damaged, or of a newer version of "
                       "the format); export the file again, or uncompressed");
    }
    tinygltf::BufferView& view = model.bufferViews[i];
    view.buffer = static_cast<int>(model.buffers.size());
    view.byteOffset = 0;
    view.byteLength = buffer.data.size();
    view.byteStride = encoded->mode == "ATTRIBUTES" ? encoded->stride : 0;
    model.buffers.push_back(std::move(buffer));
  }
  return {};
}
#else
Status decodeMeshopt(Json&, tinygltf::Model&) {
  return {};
}
#endif

}  // namespace halfshadow::scenes
