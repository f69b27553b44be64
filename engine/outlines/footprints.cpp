// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/footprints.hpp"

#include <algorithm>

namespace halfshadow::outlines {
namespace {

struct Corner {
  glm::dvec3 object, light;
};
/// A triangle that five planes have cut.
struct Polygon {
  std::array<Corner, 8> corners;
  std::size_t count = 0;
  void add(const Corner& corner) { corners[count++] = corner; }
};

/// Keeps what lies on the positive side of `distance`.
Polygon cut(const Polygon& polygon, auto distance) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Corner& from = polygon.corners[i];
    const Corner& to = polygon.corners[(i + 1) % polygon.count];
    const double before = distance(from.light), after = distance(to.light);
    if (before >= 0.0) kept.add(from);
    if ((before >= 0.0) == (after >= 0.0)) continue;
    // From inside to outside whichever way round, so that the triangle beyond the edge finds the same point.
    const bool leaves = before >= 0.0;
    const Corner &inside = leaves ? from : to, &outside = leaves ? to : from;
    const double in = leaves ? before : after, out = leaves ? after : before;
    const double t = in / (in - out);
    kept.add({glm::mix(inside.object, outside.object, t), glm::mix(inside.light, outside.light, t)});
  }
  return kept;
}

Polygon cutToVolume(Polygon polygon, const WedgeExtent& extent) {
  const auto keep = [&](auto distance) {
    if (polygon.count > 0) polygon = cut(polygon, distance);
  };
  keep([&](const glm::dvec3& p) { return p.z - extent.nearest; });
  keep([&](const glm::dvec3& p) { return p.x - extent.low(p.z).x; });
  keep([&](const glm::dvec3& p) { return extent.high(p.z).x - p.x; });
  keep([&](const glm::dvec3& p) { return p.y - extent.low(p.z).y; });
  keep([&](const glm::dvec3& p) { return extent.high(p.z).y - p.y; });
  return polygon;
}

glm::vec4 facetOf(const Polygon& triangle) {
  const glm::dvec3 a = triangle.corners[0].light;
  const glm::dvec3 n = glm::cross(triangle.corners[1].light - a, triangle.corners[2].light - a);
  const double length = glm::length(n);
  return length > 0.0 ? glm::vec4(glm::dvec4(n, glm::dot(n, a - glm::dvec3(0, 0, 1))) / length)
                      : glm::vec4(0.0f);
}

FootprintVertex projected(const Corner& corner, const WedgePieces& pieces, const WedgePiece& piece,
                          const glm::vec4& facet) {
  const double scale = 1.0 / piece.size();
  FootprintVertex vertex{
      .positionObject = glm::vec3(corner.object), .inverseSize = static_cast<float>(scale), .facet = facet};
  const glm::dvec3& p = corner.light;
  for (std::uint32_t i = 0; i < kPieceVertices; ++i) {
    const glm::dvec3& e = pieces.vertices[piece.firstVertex + std::min(i, piece.vertexCount - 1)];
    vertex.x[i] = static_cast<float>(scale * (p.z * e.x - e.z * p.x));
    vertex.y[i] = static_cast<float>(scale * (p.z * e.y - e.z * p.y));
    vertex.w[i] = static_cast<float>(scale * (p.z - e.z));
  }
  return vertex;
}
}  // namespace

ReceiverTriangles::ReceiverTriangles(const scene::TriangleMesh& meshToPlace,
                                     const glm::dmat4& worldFromObject, const scene::LightPlane& plane)
    : mesh(meshToPlace) {
  placed.reserve(mesh.positions.size());
  for (const glm::vec3& position : mesh.positions) {
    placed.push_back(plane.fromWorld(glm::dvec3(worldFromObject * glm::dvec4(position, 1.0))));
    bounds.include(placed.back());
  }
}

void addFootprints(const ReceiverTriangles& receiver, const WedgePieces& pieces, const WedgePiece& piece,
                   Footprints& result) {
  if (!reaches(piece.extent, receiver.bounds)) return;
  const auto& indices = receiver.mesh.indices;
  for (std::size_t first = 0; first + 2 < indices.size(); first += 3) {
    Polygon triangle;
    LightBox box;
    for (std::size_t i = first; i < first + 3; ++i) {
      triangle.add({glm::dvec3(receiver.mesh.positions[indices[i]]), receiver.placed[indices[i]]});
      box.include(receiver.placed[indices[i]]);
    }
    if (!reaches(piece.extent, box)) continue;
    const Polygon polygon = cutToVolume(triangle, piece.extent);
    if (polygon.count < 3) continue;
    double nearest = polygon.corners[0].light.z;
    for (std::size_t i = 1; i < polygon.count; ++i) nearest = std::min(nearest, polygon.corners[i].light.z);
    const bool beyond = nearest - piece.extent.farthest >= kAllVerticesNear * piece.size();
    auto& stream = beyond ? result.beyond : result.beside;
    const glm::vec4 facet = facetOf(triangle);
    std::array<FootprintVertex, 8> vertices;
    for (std::size_t i = 0; i < polygon.count; ++i)
      vertices[i] = projected(polygon.corners[i], pieces, piece, facet);
    for (std::size_t i = 2; i < polygon.count; ++i)
      stream.insert(stream.end(), {vertices[0], vertices[i - 1], vertices[i]});
  }
}

}  // namespace halfshadow::outlines
