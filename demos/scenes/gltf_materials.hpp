// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// glTF materials as base colours, images and alpha cutoffs (internal).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene_description.hpp"
#include "scenes/gltf_images.hpp"

namespace halfshadow::scenes {

/// Least and greatest alpha.
struct AlphaRange {
  float low = 1.0f, high = 1.0f;
  void times(const AlphaRange& other) { low *= other.low, high *= other.high; }
};

struct GltfMaterial {
  scene::Material material;
  AlphaRange imageAlpha;  ///< of materials with a cutoff: looked for once, whatever shows the image
  bool blends = false;    ///< alphaMode BLEND, which is cut like MASK
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

/// What there is of an object of this material.
enum class Presence { nothing, withHoles, whole };
/// Looks at all alpha that the object has: one without a hole anywhere need not be cut.
Presence presenceOf(const GltfMaterial& material, const scene::TriangleMesh& mesh);

}  // namespace halfshadow::scenes
