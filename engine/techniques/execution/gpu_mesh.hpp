// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A mesh on the GPU, made once and drawn by light and receiver passes alike.
#pragma once

#include <cstdint>
#include <vector>

#include "gl/encoder.hpp"
#include "scene/mesh.hpp"
#include "techniques/core/draw_item.hpp"

namespace halfshadow::techniques {

/// Streams of one mesh: positions (12 bytes a vertex) with indices; normals and texture coordinates where the
/// source has them, and colours (read by shading, and where alpha cuts holes); and a facet stream (position
/// and facet normal, 24 bytes, three vertices a triangle), since the receiver-plane bias needs the exact
/// facet plane: for every mesh where derivatives or highp are missing, elsewhere for meshes of few triangles,
/// whose fragments then need no derivatives. Meshes without normals are shaded by it where derivatives are
/// missing. Meshes of more than 65,536 vertices are split into ranges where 32-bit indices are missing.
class GpuMesh {
 public:
  using Streams = MeshStreams;

  /// `extras`: what draws of positions and facets will ask for at most.
  static Result<GpuMesh> create(gl::Context& context, const scene::TriangleMesh& mesh,
                                MeshExtras extras = MeshExtras::none);
  /// Replaces positions and normals (same topology): animated casters. Errors: outOfMemory, invalidArgument.
  Status update(gl::Context& context, const scene::TriangleMesh& mesh);

  bool hasFacetStream() const { return static_cast<bool>(facet_); }
  /// `facet` only where hasFacetStream(). One draw per range.
  void draw(gl::Encoder& encoder, const gl::DrawState& state, Streams streams,
            MeshExtras extras = MeshExtras::none) const;
  std::uint64_t memoryBytes() const;

 private:
  struct Range {
    std::size_t firstVertex = 0, firstIndex = 0, indexCount = 0;
  };
  void split(const scene::TriangleMesh& mesh, bool wideIndices);
  Status upload(gl::Context& context, const scene::TriangleMesh& mesh);

  Status uploadSurface(gl::Context& context, const scene::TriangleMesh& mesh, MeshExtras extras);
  void drawFacets(gl::Encoder& encoder, const gl::DrawState& state, bool withSurface) const;

  gl::Buffer positions_, indices_, normals_, texcoords_, colors_, facet_, facetTexcoords_, facetColors_;
  gl::IndexType indexType_ = gl::IndexType::uint16;
  std::vector<Range> ranges_;
  std::vector<std::uint32_t> sourceVertex_;  ///< of each GPU vertex
  std::vector<std::uint32_t> gpuIndices_;    ///< relative to the range's first vertex
  std::size_t facetVertexCount_ = 0;
  bool shadedByFacets_ = false;
};

}  // namespace halfshadow::techniques
