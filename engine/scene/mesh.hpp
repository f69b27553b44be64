// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Triangle meshes as the engine holds them: checked once, then trusted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/error.hpp"

namespace halfshadow::scene {

/// A caller's triangle list, read once by buildMesh and never kept.
/// `positions`: vertexCount × 3 floats, object space, scene units; `positionStrideBytes` from one vertex to
/// the next (>= 12). `indices`: indexCount entries, a multiple of 3, in either winding; null = 0, 1, 2, … (as
/// many as indexCount says, or all vertices when that is 0). `normals` (unit, optional),
/// `texcoords` and `colors` (optional) are tightly packed, vertexCount entries each.
struct MeshView {
  const float* positions = nullptr;
  std::size_t positionStrideBytes = 12;
  std::uint32_t vertexCount = 0;
  const std::uint32_t* indices = nullptr;
  std::size_t indexCount = 0;
  const float* normals = nullptr;    ///< vertexCount × 3 or null
  const float* texcoords = nullptr;  ///< vertexCount × 2 or null
  const float* colors = nullptr;     ///< vertexCount × 4, linear, or null
};

/// What checking a mesh found.
struct MeshStatistics {
  std::uint32_t degenerateTrianglesDropped = 0;  ///< zero area or a repeated index
  std::uint32_t duplicateTrianglesDropped = 0;   ///< same three corners (same winding) as an earlier one
  std::uint32_t boundaryEdges = 0;     ///< directed edges without their opposite, welded, windings mended
  std::uint32_t nonManifoldEdges = 0;  ///< undirected edges with more than two triangles
  bool closed() const { return boundaryEdges == 0; }
};

inline constexpr std::uint32_t kNoShell = ~0u;

/// A checked triangle mesh: every index is in range, every position finite, no zero-area triangle, closed
/// shells wound alike and outward (see windings.hpp). Vertices keep their attributes (not welded);
/// `weldedVertex` maps each vertex to the first vertex with bitwise equal position, for adjacency.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  std::vector<glm::vec3> normals;    ///< empty or one per vertex
  std::vector<glm::vec2> texcoords;  ///< empty or one per vertex
  std::vector<glm::vec4> colors;     ///< empty or one per vertex
  std::vector<std::uint32_t> weldedVertex;
  std::vector<std::uint32_t> shellOf;  ///< per triangle: its closed shell, or kNoShell
  std::uint32_t shellCount = 0;
  std::vector<std::uint8_t> turned;  ///< per triangle: the source wound it the other way; empty = none
  MeshStatistics statistics;
  std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(indices.size() / 3); }
};

/// Copies, checks and cleans a mesh and mends its windings. Errors: invalidMesh (index out of range, index
/// count not a multiple of 3, NaN or infinite position — the message names the first offending element),
/// emptyScene (nothing left).
Result<TriangleMesh> buildMesh(const MeshView& view);

/// Moves the triangles' box to the origin, along each axis on which its far side is at most twice as far from
/// there as its near side: then every difference is exact in float (Sterbenz), so that the shape stays as it
/// is while what is computed from the positions keeps all their digits. Returns what was subtracted.
glm::dvec3 recenter(TriangleMesh& mesh);

/// Winds each closed shell outward again after its positions were replaced (a pose may mirror it). True when
/// any triangle was turned.
bool turnShellsOutward(TriangleMesh& mesh);

}  // namespace halfshadow::scene
