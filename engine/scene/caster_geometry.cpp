// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/caster_geometry.hpp"

namespace halfshadow::scene {

const HalfEdgeMesh& CasterGeometry::halfEdges(const TriangleMesh& mesh) const {
  if (!built_) {
    if (isCut()) cut_ = cutByAlpha(mesh, alpha_);
    halfEdges_ = HalfEdgeMesh::build(isCut() ? cut_.mesh : mesh);
  } else if (stale_) {
    if (isCut()) cut_.follow(mesh);
    halfEdges_.updatePositions(isCut() ? cut_.mesh : mesh);
  }
  built_ = true;
  stale_ = false;
  return halfEdges_;
}

const TriangleMesh& CasterGeometry::triangles(const TriangleMesh& mesh) const {
  if (!isCut()) return mesh;
  halfEdges(mesh);
  return cut_.mesh;
}

}  // namespace halfshadow::scene
