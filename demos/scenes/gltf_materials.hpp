// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// glTF materials as base colours, images and alpha cutoffs (internal).
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "scene/alpha_pyramid.hpp"
#include "scene/scene_description.hpp"
#include "scenes/gltf_images.hpp"

namespace halfshadow::scenes {

struct GltfMaterial {
  scene::Material material;
  /// Of the image of a material with a cutoff: made once, whatever shows it; null: it has none.
  std::shared_ptr<const scene::AlphaPyramid> imageAlpha;
  bool blends = false;  ///< alphaMode BLEND, which is cut like MASK
};

/// What beginDecoding() is to begin: one per material of the file, -1 where it has none.
std::vector<int> baseColorTextures(const tinygltf::Model& model);

/// One per material of the file. Images that cannot be used leave a note and a plain colour.
std::vector<GltfMaterial> materialsOf(const tinygltf::Model& model, GltfImages& images);

/// Where a material's base colour image is looked up.
struct TextureCoordinates {
  int set = 0;                                   ///< TEXCOORD_n
  glm::dmat3x2 imageFromFile{1, 0, 0, 1, 0, 0};  ///< times (u, v, 1): KHR_texture_transform
};
TextureCoordinates textureCoordinatesOf(const tinygltf::Material& material);

}  // namespace halfshadow::scenes
