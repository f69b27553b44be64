// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Images of glTF files, decoded when a material asks for them (internal).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/scene_description.hpp"
#include "scenes/gltf_file.hpp"

namespace halfshadow::scenes {

class GltfImages {
 public:
  GltfImages(const tinygltf::Model& model, std::vector<std::string>& notes)
      : model_(model), notes_(notes), images_(model.images.size()), isTried_(model.images.size()) {}

  /// Of a texture of the file: PNG or JPEG, or WebP under EXT_texture_webp. Null, with a note, where there is
  /// none that can be decoded.
  std::shared_ptr<const scene::Image> ofTexture(int texture);

 private:
  std::shared_ptr<const scene::Image> at(int index);
  Result<scene::Image> decoded(int index) const;
  void addNote(std::string note);

  const tinygltf::Model& model_;
  std::vector<std::string>& notes_;
  std::vector<std::shared_ptr<const scene::Image>> images_;
  std::vector<char> isTried_;
};

}  // namespace halfshadow::scenes
