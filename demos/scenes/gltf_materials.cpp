// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_materials.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>

#include "scenes/gltf_accessors.hpp"

namespace halfshadow::scenes {
namespace {
/// Decodes an image in a buffer view, or says why not.
Status decodeFromView(const tinygltf::Model& model, tinygltf::Image& image, int index) {
  const Result<ByteRange> range = bytesOfView(model, image.bufferView);
  if (!range) return range.error();
  std::string error, warning;
  bool decoded = false;
  image.width = image.height = -1;
  try {
    decoded = range->size > 0 && tinygltf::LoadImageData(&image, index, &error, &warning, 0, 0, range->begin,
                                                         static_cast<int>(range->size), nullptr);
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!decoded) return malformed("its bytes are not a PNG or JPEG image that can be decoded");
  return {};
}

/// 8 bits per channel, 3 or 4 channels; null when the sizes do not fit together.
std::shared_ptr<const scene::Image> converted(const tinygltf::Image& source) {
  const bool isWide = source.bits == 16;
  if (source.width <= 0 || source.height <= 0 || source.component < 1 || source.component > 4 ||
      (source.bits != 8 && !isWide)) {
    return nullptr;
  }
  const auto pixelCount = static_cast<std::size_t>(source.width) * static_cast<std::size_t>(source.height);
  const auto channels = static_cast<std::size_t>(source.component);
  if (source.image.size() != pixelCount * channels * (isWide ? 2 : 1)) return nullptr;
  const auto value = [&](std::size_t i) { return source.image[isWide ? 2 * i + 1 : i]; };  // high byte of two
  scene::Image image{.width = source.width, .height = source.height};
  const bool hasAlpha = channels == 2 || channels == 4, isGrey = channels <= 2;
  image.channels = hasAlpha ? 4 : 3;
  image.pixels.reserve(pixelCount * static_cast<std::size_t>(image.channels));
  for (std::size_t p = 0; p < pixelCount; ++p) {
    for (std::size_t c = 0; c < 3; ++c) image.pixels.push_back(value(p * channels + (isGrey ? 0 : c)));
    if (hasAlpha) image.pixels.push_back(value(p * channels + channels - 1));
  }
  return std::make_shared<const scene::Image>(std::move(image));
}

/// Images by index, decoded when first asked for.
class ImageCache {
 public:
  ImageCache(tinygltf::Model& model, std::vector<std::string>& notes)
      : model_(model), notes_(notes), images_(model.images.size()), isTried_(model.images.size()) {}

  std::shared_ptr<const scene::Image> at(int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= images_.size()) {
      addNote("a base colour texture has no PNG or JPEG image; a plain colour is used");
      return nullptr;
    }
    if (isTried_[index]) return images_[index];
    isTried_[index] = true;
    tinygltf::Image& source = model_.images[index];
    std::string reason = "it is missing or not a PNG or JPEG image";
    if (source.bufferView != -1) {
      if (Status status = decodeFromView(model_, source, index); !status) reason = status.error().message;
    }
    images_[index] = converted(source);
    if (!images_[index]) {
      const std::string name = source.uri.empty() ? "" : " '" + source.uri.substr(0, 80) + "'";
      notes_.push_back("image " + std::to_string(index) + name + " is not used: " + reason);
    }
    return images_[index];
  }

 private:
  void addNote(std::string note) {
    if (std::find(notes_.begin(), notes_.end(), note) == notes_.end()) notes_.push_back(std::move(note));
  }

  tinygltf::Model& model_;
  std::vector<std::string>& notes_;
  std::vector<std::shared_ptr<const scene::Image>> images_;
  std::vector<char> isTried_;
};
}  // namespace

std::vector<scene::Material> materialsOf(tinygltf::Model& model, std::vector<std::string>& notes) {
  ImageCache images(model, notes);
  std::vector<scene::Material> materials;
  for (const tinygltf::Material& source : model.materials) {
    scene::Material material;
    const std::vector<double>& factor = source.pbrMetallicRoughness.baseColorFactor;
    material.baseColor = glm::vec4(1.0f);
    for (int c = 0; c < 4 && factor.size() == 4; ++c) {
      material.baseColor[c] = std::isfinite(factor[c]) ? static_cast<float>(factor[c]) : 1.0f;
    }
    material.doubleSided = source.doubleSided;
    if (const int texture = source.pbrMetallicRoughness.baseColorTexture.index; texture >= 0) {
      if (static_cast<std::size_t>(texture) < model.textures.size()) {
        material.baseColorImage = images.at(model.textures[texture].source);
      } else {
        notes.push_back("texture " + std::to_string(texture) + " does not exist; a plain colour is used");
      }
    }
    materials.push_back(std::move(material));
  }
  return materials;
}

}  // namespace halfshadow::scenes
