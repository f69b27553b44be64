// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Half-edges of an object's mesh, as outlines take it.
#pragma once

#include "scene/cut_by_alpha.hpp"
#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scene {

/// Half-edges of one object, built when first asked for: scenes drawn with depth maps never need them.
class CasterGeometry {
 public:
  CasterGeometry() = default;
  /// Of a mesh into which alpha cuts holes: of what is left of it.
  explicit CasterGeometry(AlphaCut alpha) : alpha_(std::move(alpha)) {}
  /// `mesh` is the same in every call.
  const HalfEdgeMesh& halfEdges(const TriangleMesh& mesh) const;
  /// What they are made of: the mesh, or what alpha leaves of it.
  const TriangleMesh& triangles(const TriangleMesh& mesh) const;
  /// The mesh's positions were replaced.
  void positionsChanged() { stale_ = true; }
  /// Alpha cuts finer than the half-edges follow it; known once they were asked for.
  bool isCoarse() const { return cut_.coarse; }

 private:
  bool isCut() const { return alpha_.cutoff > 0.0f; }
  AlphaCut alpha_;
  mutable CutMesh cut_;
  mutable HalfEdgeMesh halfEdges_;
  mutable bool built_ = false, stale_ = false;
};

}  // namespace halfshadow::scene
