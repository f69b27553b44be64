// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include "scene/bounds.hpp"
#include "scene/edge_uses.hpp"
#include "scene/windings.hpp"

namespace halfshadow::scene {
namespace {
using Corners = std::array<std::uint32_t, 3>;

/// Numbers of things under a hash of three words each: open addressing, at most half full.
class CornersTable {
 public:
  explicit CornersTable(std::size_t most)
      : bits_(static_cast<int>(std::bit_width(std::max<std::size_t>(most, 2))) + 1),
        places_(std::size_t{1} << bits_, kFree) {}

  /// The number of an earlier thing that `isSame(number)` tells equal, else `number`, which is added.
  template <typename IsSame>
  std::uint32_t firstEqual(const Corners& corners, std::uint32_t number, const IsSame& isSame) {
    for (std::size_t at = placeOf(corners);; at = (at + 1) & (places_.size() - 1)) {
      if (places_[at] == kFree) return places_[at] = number;
      if (isSame(places_[at])) return places_[at];
    }
  }

 private:
  static constexpr std::uint32_t kFree = ~0u;
  std::size_t placeOf(const Corners& c) const {
    constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ull;
    std::uint64_t hash = (c[0] | std::uint64_t{c[1]} << 32) * kOdd;
    hash = (hash ^ hash >> 32 ^ c[2]) * kOdd;
    hash = (hash ^ hash >> 29) * kOdd;
    return static_cast<std::size_t>(hash >> (64 - bits_));
  }
  int bits_;
  std::vector<std::uint32_t> places_;
};

Corners positionBits(const glm::vec3& p) {
  // + 0 turns -0 into 0: both are the same place.
  return {std::bit_cast<std::uint32_t>(p.x + 0.0f), std::bit_cast<std::uint32_t>(p.y + 0.0f),
          std::bit_cast<std::uint32_t>(p.z + 0.0f)};
}

Result<std::vector<glm::vec3>> copyPositions(const MeshView& view) {
  if (view.vertexCount > 0 && view.positions == nullptr) {
    return Error{ErrorCode::invalidMesh, "the mesh has vertices but no positions; set positions"};
  }
  if (view.positionStrideBytes < 12) {
    return Error{ErrorCode::invalidMesh, "the position stride is " +
                                             std::to_string(view.positionStrideBytes) +
                                             " bytes; three floats need at least 12"};
  }
  std::vector<glm::vec3> positions(view.vertexCount);
  const auto* bytes = reinterpret_cast<const unsigned char*>(view.positions);
  for (std::uint32_t i = 0; i < view.vertexCount; ++i) {
    std::memcpy(&positions[i], bytes + i * view.positionStrideBytes, 12);
    const glm::vec3& p = positions[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return Error{ErrorCode::invalidMesh, "the position of vertex " + std::to_string(i) +
                                               " is NaN or infinite; give finite numbers"};
    }
  }
  return positions;
}

std::vector<std::uint32_t> weldByPosition(const std::vector<glm::vec3>& positions) {
  CornersTable firstAt(positions.size());
  std::vector<std::uint32_t> welded(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const Corners bits = positionBits(positions[i]);
    welded[i] = firstAt.firstEqual(
        bits, i, [&](std::uint32_t other) { return positionBits(positions[other]) == bits; });
  }
  return welded;
}

bool hasArea(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  // In double: products of float differences are exact enough not to round a thin triangle to nothing.
  const glm::dvec3 origin(a);
  const glm::dvec3 normal = glm::cross(glm::dvec3(b) - origin, glm::dvec3(c) - origin);
  return glm::dot(normal, normal) > 0.0;
}

Corners rotatedToSmallestFirst(const Corners& c) {
  const auto first = std::min_element(c.begin(), c.end()) - c.begin();
  return {c[first], c[(first + 1) % 3], c[(first + 2) % 3]};
}

std::vector<EdgeUse> weldedEdgeUses(const TriangleMesh& mesh) {
  std::vector<glm::uvec3> faces(mesh.triangleCount());
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    faces[i / 3][static_cast<int>(i % 3)] = mesh.weldedVertex[mesh.indices[i]];
  }
  return edgeUses(faces);
}

/// An edge is boundary where its two directions differ. `uses` are of the windings before they were mended.
void countEdges(TriangleMesh& mesh, std::span<const EdgeUse> uses) {
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    int sum = 0;
    for (const EdgeUse& use : edge) {
      const bool turned = !mesh.turned.empty() && mesh.turned[use.face] != 0;
      sum += use.forward != turned ? 1 : -1;
    }
    mesh.statistics.boundaryEdges += static_cast<std::uint32_t>(std::abs(sum));
    mesh.statistics.nonManifoldEdges += edge.size() > 2;
  });
}
}  // namespace

Result<TriangleMesh> buildMesh(const MeshView& view) {
  Result<std::vector<glm::vec3>> positions = copyPositions(view);
  if (!positions) return positions.error();
  const std::size_t cornerCount =
      view.indices == nullptr && view.indexCount == 0 ? view.vertexCount : view.indexCount;
  if (cornerCount % 3 != 0) {
    return Error{ErrorCode::invalidMesh, "the index count " + std::to_string(cornerCount) +
                                             " is not a multiple of 3; give three per triangle"};
  }

  TriangleMesh mesh;
  mesh.positions = std::move(positions).value();
  mesh.weldedVertex = weldByPosition(mesh.positions);
  mesh.indices.reserve(cornerCount);
  CornersTable known(cornerCount / 3);
  std::vector<Corners> kept;  // triangles by welded corners, the smallest first
  kept.reserve(cornerCount / 3);
  for (std::size_t first = 0; first < cornerCount; first += 3) {
    Corners corners, welded;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = view.indices != nullptr ? view.indices[first + k] : static_cast<std::uint32_t>(first + k);
      if (corners[k] >= view.vertexCount) {
        return Error{ErrorCode::invalidMesh, "index " + std::to_string(first + k) + " is " +
                                                 std::to_string(corners[k]) + " but there are only " +
                                                 std::to_string(view.vertexCount) + " vertices"};
      }
      welded[k] = mesh.weldedVertex[corners[k]];
    }
    if (!hasArea(mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]])) {
      ++mesh.statistics.degenerateTrianglesDropped;
      continue;
    }
    const Corners key = rotatedToSmallestFirst(welded);
    const auto number = static_cast<std::uint32_t>(kept.size());
    if (known.firstEqual(key, number, [&](std::uint32_t other) { return kept[other] == key; }) != number) {
      ++mesh.statistics.duplicateTrianglesDropped;
      continue;
    }
    kept.push_back(key);
    mesh.indices.insert(mesh.indices.end(), corners.begin(), corners.end());
  }
  if (mesh.indices.empty()) {
    return Error{ErrorCode::emptyScene, "the mesh has no triangle with an area; give at least one"};
  }
  if (view.normals != nullptr) {
    const auto* n = reinterpret_cast<const glm::vec3*>(view.normals);
    mesh.normals.assign(n, n + view.vertexCount);
  }
  if (view.texcoords != nullptr) {
    const auto* t = reinterpret_cast<const glm::vec2*>(view.texcoords);
    mesh.texcoords.assign(t, t + view.vertexCount);
  }
  if (view.colors != nullptr) {
    const auto* c = reinterpret_cast<const glm::vec4*>(view.colors);
    mesh.colors.assign(c, c + view.vertexCount);
  }
  const std::vector<EdgeUse> uses = weldedEdgeUses(mesh);
  mendWindings(mesh, uses);
  countEdges(mesh, uses);
  return mesh;
}

glm::dvec3 recenter(TriangleMesh& mesh) {
  const Bounds bounds = boundsOf(mesh);
  glm::vec3 center(0.0f);
  for (int axis = 0; axis < 3; ++axis) {
    const double low = bounds.low[axis], high = bounds.high[axis];
    const double nearSide = std::min(std::abs(low), std::abs(high)),
                 farSide = std::max(std::abs(low), std::abs(high));
    if (low * high > 0.0 && farSide <= 2.0 * nearSide) center[axis] = static_cast<float>(0.5 * (low + high));
  }
  if (center == glm::vec3(0.0f)) return glm::dvec3(0.0);
  for (glm::vec3& position : mesh.positions) position -= center;
  return glm::dvec3(center);
}

}  // namespace halfshadow::scene
