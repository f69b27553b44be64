// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Images of glTF files, decoded when a material asks for them (internal).
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "scene/scene_description.hpp"
#include "scenes/gltf_file.hpp"

namespace halfshadow::scenes {

class GltfImages {
 public:
  GltfImages(const tinygltf::Model& model, std::vector<std::string>& notes)
      : model_(model),
        notes_(notes),
        ahead_(model.images.size()),
        images_(model.images.size()),
        isTried_(model.images.size()) {}

  ~GltfImages();
  GltfImages(const GltfImages&) = delete;
  GltfImages& operator=(const GltfImages&) = delete;

  /// Begins to decode the images of these textures on threads of its own, which only read the model, while
  /// others make meshes of it. Called once, before anything is asked for.
  void beginDecoding(const std::vector<int>& textures);
  /// Of a texture of the file: PNG or JPEG, or WebP under EXT_texture_webp. Null, with a note, where there is
  /// none that can be decoded. Waits for what was begun.
  std::shared_ptr<const scene::Image> ofTexture(int texture);

 private:
  void decodeWanted();
  void endDecoding();
  std::shared_ptr<const scene::Image> at(int index);
  Result<scene::Image> decoded(int index) const;
  void addNote(std::string note);

  const tinygltf::Model& model_;
  std::vector<std::string>& notes_;
  std::vector<std::optional<Result<scene::Image>>> ahead_;  ///< decoded, not yet taken
  std::vector<std::shared_ptr<const scene::Image>> images_;
  std::vector<char> isTried_;
  std::vector<int> wanted_;            ///< images that are decoded ahead, each once
  std::atomic<std::size_t> next_{0};   ///< of them: the first that nobody has begun
  std::vector<std::jthread> helpers_;  ///< the last member: they end before what they write to
};

}  // namespace halfshadow::scenes
