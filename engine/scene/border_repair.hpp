// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Closes gaps along open borders: near vertices, vertices on edges, cracks (internal to engine/scene).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace halfshadow::scene {

/// A face, and whether repairing a T-junction split it off another.
struct SoupFace {
  glm::uvec3 corners{0};
  bool splitOff = false;
};

/// Merges vertices of open borders that are within 1e-6 of the mesh's size; faces that vanish are dropped.
/// Returns how many vertices were merged into others.
std::uint32_t mergeNearBorderVertices(std::vector<SoupFace>& faces, std::span<const glm::vec3> positions);

/// Splits open edges at vertices of open borders that lie on them and continue along them.
void splitTJunctions(std::vector<SoupFace>& faces, std::span<const glm::vec3> positions);

/// A closed chain of open edges, in their faces' direction.
using BorderLoop = std::vector<std::uint32_t>;
/// Loops of the edges that only one face uses; chains that end at edges of more faces are left out.
std::vector<BorderLoop> borderLoops(std::span<const glm::uvec3> faces);

struct Filling {
  std::vector<glm::uvec3> faces;
  double area = 0.0;
  double perimeter = 0.0;
};
/// Triangles that close a loop, zipped from its sharpest corner: for a crack their area is next to nothing.
Filling fillLoop(const BorderLoop& loop, std::span<const glm::vec3> positions);

}  // namespace halfshadow::scene
