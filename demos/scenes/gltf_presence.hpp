// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What alpha leaves of a mesh (internal).
#pragma once

#include <memory>

#include "scenes/gltf_materials.hpp"

namespace halfshadow::scenes {

/// What there is of an object.
struct PresentMesh {
  /// Without triangles that are transparent all over; null: there is nothing else.
  std::shared_ptr<const scene::TriangleMesh> mesh;
  bool hasHoles = false;  ///< in what is left
};

/// Looks at all alpha that each triangle has: base colour, vertex colours, and the image over a rectangle
/// around its texture coordinates. Panes of glass that share a texture with the car around them are not there
/// at all, instead of holes that only some techniques see. The mesh itself where every triangle stays.
PresentMesh presentMesh(const GltfMaterial& material, std::shared_ptr<const scene::TriangleMesh> mesh);

}  // namespace halfshadow::scenes
