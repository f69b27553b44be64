// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Meshes that end where alpha does: outlines see leaves and fences in place of the cards that show them.
#pragma once

#include <memory>
#include <vector>

#include "scene/scene_description.hpp"

namespace halfshadow::scene {

/// Where a mesh has holes.
struct AlphaCut {
  std::shared_ptr<const Image> mask;  ///< of its alpha; null: there is no image
  ImageSampling sampling;
  float cutoff = 0.0f;  ///< nothing is where alpha of mask times vertex colour is less
};

/// Positions and triangles alone.
struct CutMesh {
  TriangleMesh mesh;
  /// Each vertex lies between two earlier ones, at `share` of the way from the first; those of the uncut mesh
  /// come first, and between themselves.
  struct Source {
    std::uint32_t from = 0, to = 0;
    float share = 0.0f;
  };
  std::vector<Source> sources;
  bool coarse = false;  ///< more triangles than asked for would have followed alpha better

  /// Places its vertices anew; `uncut` is the mesh that it was cut from, with other positions.
  void follow(const TriangleMesh& uncut);
};

/// `mesh` without what alpha cuts out of it. Triangles that alpha runs through are halved where what they
/// hold and what is cut off along straight lines differ most, until that is .03 % of what each was part
/// of or there are `mostTriangles` more than before; neighbours have the same points on their common
/// edge.
CutMesh cutByAlpha(const TriangleMesh& mesh, const AlphaCut& alpha, std::size_t mostTriangles = 60000);

}  // namespace halfshadow::scene
