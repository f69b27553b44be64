// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_file.hpp"

#include <exception>
#include <filesystem>

#include "scenes/gltf_decode.hpp"
#include "scenes/gltf_extensions.hpp"

namespace halfshadow::scenes {
namespace {
/// tinygltf hands over image bytes in buffer views without checking their range, so those are not touched
/// here; others are kept as they are, and decoded when a material asks for them.
bool keepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
  if (image->bufferView == -1 && bytes != nullptr && size > 0) image->image.assign(bytes, bytes + size);
  image->width = -1;
  return true;
}

std::string firstLine(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "it does not follow the glTF 2.0 schema" : line.substr(0, 300);
}

struct Parsed {
  bool done = false;
  std::string error;
};

Parsed parse(tinygltf::Model& model, const GltfDocument& document, const FileBytes& file,
             const std::string& folder, bool isChanged) {
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(keepEncoded, nullptr);
  Parsed result;
  std::string warning;
  if (document.isBinary) {
    const FileBytes changed = isChanged ? glbOf(document.json, document.binary) : FileBytes();
    const FileBytes& bytes = isChanged ? changed : file;
    result.done = parser.LoadBinaryFromMemory(&model, &result.error, &warning, bytes.data(),
                                              static_cast<unsigned int>(bytes.size()), folder);
  } else {
    const std::string changed = isChanged ? document.json.dump() : std::string();
    const std::string_view text = isChanged ? std::string_view(changed) : document.text;
    result.done = parser.LoadASCIIFromString(&model, &result.error, &warning, text.data(),
                                             static_cast<unsigned int>(text.size()), folder);
  }
  return result;
}
}  // namespace

Result<GltfFile> parseGltfFile(const std::string& path) {
  Result<FileBytes> bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  Result<GltfDocument> document = documentOf(*bytes);
  if (!document) return document.error();
  if (Status status = checkRequiredExtensions(document->json); !status) return status.error();

  GltfFile file;
  Parsed parsed;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const ParserDetour detour = takeDetour(document->json, document->isBinary);
  try {  // tinygltf and its JSON library throw on some wrong types and on absurd sizes
    parsed = parse(file.model, *document, *bytes, folder, detour.isNeeded());
  } catch (const std::exception& exception) {
    parsed = {.error = exception.what()};
  }
  if (!parsed.done)
    return malformed("it is not a readable glTF 2.0 file (" + firstLine(parsed.error) + "); export it again");
  *bytes = {};  // the model has its own copy
  undoDetour(detour, file.model);
  if (Status status = decodeGeometry(document->json, file.model); !status) return status.error();
  file.notes = unhonouredExtensions(document->json);
  return file;
}

}  // namespace halfshadow::scenes
