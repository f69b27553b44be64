// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "layer_count.hpp"

#include <cmath>

namespace halfshadow::testing {

std::optional<int> layersByRay(const scene::HalfEdgeMesh& mesh, std::uint32_t part, const glm::dvec3& light,
                               const glm::dvec3& direction, Side side) {
  const scene::CasterPart& own = mesh.parts()[part];
  int count = 0;
  for (std::uint32_t f = own.firstFace; f < own.firstFace + own.faceCount; ++f) {
    const glm::uvec3& face = mesh.faces()[f];
    const glm::dvec3 a = glm::dvec3(mesh.positions()[face.x]) - light;
    const glm::dvec3 b = glm::dvec3(mesh.positions()[face.y]) - light;
    const glm::dvec3 c = glm::dvec3(mesh.positions()[face.z]) - light;
    // Volumes that the ray spans with the edges: all of one sign where it passes through the triangle.
    const double u = glm::dot(direction, glm::cross(b, c)), v = glm::dot(direction, glm::cross(c, a));
    const double w = glm::dot(direction, glm::cross(a, b)), volume = glm::dot(a, glm::cross(b, c));
    const bool inside = (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
    const double nearest = std::min(std::abs(u), std::min(std::abs(v), std::abs(w)));
    // 1e-6 of the whole: far above what float planes and positions leave open.
    if (nearest < 1e-6 * (std::abs(u) + std::abs(v) + std::abs(w)) &&
        (inside || std::abs(u + v + w) > 0.99 * (std::abs(u) + std::abs(v) + std::abs(w)))) {
      return std::nullopt;
    }
    if (!inside || volume / (u + v + w) <= 0.0) continue;
    count += (volume < 0.0) == (side == Side::towards);
  }
  return count;
}

int layerDifference(const scene::HalfEdgeMesh& mesh, const scene::Silhouette& silhouette, std::uint32_t part,
                    const glm::dvec3& light, const glm::dvec3& from, const glm::dvec3& to, Side side) {
  const glm::dvec3 arc = glm::cross(from, to);
  int difference = 0;
  for (const scene::Silhouette::Part& entry : silhouette.parts) {
    if (entry.part != part || entry.turnedAway != (side == Side::away)) continue;
    for (std::uint32_t l = entry.firstLoop; l < entry.firstLoop + entry.loopCount; ++l) {
      const scene::Silhouette::Loop& loop = silhouette.loops[l];
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const std::uint32_t p = silhouette.vertices[loop.first + i];
        const std::uint32_t q = silhouette.vertices[loop.first + (i + 1) % loop.count];
        const glm::dvec3 u = glm::dvec3(mesh.positions()[p]) - light;
        const glm::dvec3 v = glm::dvec3(mesh.positions()[q]) - light;
        const glm::dvec3 plane = glm::cross(u, v);
        const double arcU = glm::dot(arc, u), arcV = glm::dot(arc, v);
        const double edgeFrom = glm::dot(plane, from), edgeTo = glm::dot(plane, to);
        if ((arcU > 0) == (arcV > 0) || (edgeFrom > 0) == (edgeTo > 0)) continue;
        if ((arcU > 0) != (edgeTo > 0)) continue;  // they meet on the other side of the sphere
        difference += edgeFrom < 0 ? 1 : -1;       // what a loop covers lies below its edges' planes
      }
    }
  }
  return difference;
}

}  // namespace halfshadow::testing
