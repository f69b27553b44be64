// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/supporting_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "scene/convex_hull.hpp"

namespace halfshadow::scene {
namespace {
/// Faces that are tried: the largest, since it is grounds, walls and sides of boxes that things stand before.
constexpr std::size_t kMostTried = 64;
constexpr std::size_t kMostPlanes = 32;
/// Two roundings to float, of the vertex and of the plane's.
constexpr double kRounding = 1.0 / (1 << 22);

struct Face {
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 normal{0.0};
};

Face faceOf(const TriangleMesh& mesh, std::size_t triangle) {
  Face face;
  for (std::size_t k = 0; k < 3; ++k) face.corners[k] = mesh.positions[mesh.indices[3 * triangle + k]];
  const glm::dvec3 cross = glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
  const double length = glm::length(cross);
  if (length > 0.0) face.normal = cross / length;
  return face;
}

std::vector<std::size_t> largestFaces(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.triangleCount());
  std::vector<std::size_t> order(mesh.triangleCount());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const Face face = faceOf(mesh, t);
    areas[t] = glm::length(glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]));
  }
  const std::size_t count = std::min(kMostTried, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
      [&](std::size_t a, std::size_t b) { return areas[a] != areas[b] ? areas[a] > areas[b] : a < b; });
  order.resize(count);
  return order;
}

class Finder {
 public:
  Finder(const TriangleMesh& mesh, SupportingPlanes& planes) : mesh_(mesh), planes_(planes) {
    std::vector<bool> seen(mesh.positions.size(), false);
    for (const std::uint32_t index : mesh.indices) {
      const std::uint32_t vertex = mesh.weldedVertex[index];
      if (seen[vertex]) continue;
      seen[vertex] = true;
      vertices_.push_back(vertex);
    }
  }

  void find() {
    for (const std::size_t triangle : largestFaces(mesh_)) {
      const Face face = faceOf(mesh_, triangle);
      if (face.normal == glm::dvec3(0.0) || liesInAny(face)) continue;
      for (const double side : {1.0, -1.0}) {
        if (planes_.ofFaces.size() < kMostPlanes) addIfSupporting(face, side * face.normal);
      }
    }
    bool all = !planes_.ofFaces.empty();
    for (std::size_t t = 0; t < mesh_.triangleCount() && all; ++t) all = liesInAny(faceOf(mesh_, t));
    planes_.planar =
        all && planes_.ofFaces.size() == 2 &&
        glm::dot(planes_.ofFaces[0].normal, planes_.ofFaces[1].normal) < 0.0 &&
        planes_.ofFaces[0].offset + planes_.ofFaces[1].offset <= roundingAlong(planes_.ofFaces[0].normal);
    const bool isBody = all && !planes_.planar && mesh_.shellCount == 1 && mesh_.statistics.closed() &&
                        mesh_.statistics.nonManifoldEdges == 0;
    planes_.convex = isBody;
    if (!planes_.planar && !planes_.convex) return;
    for (SupportingPlane& plane : planes_.ofFaces) findOutline(plane);
  }

 private:
  double roundingAlong(const glm::dvec3& normal) const {
    return kRounding * glm::dot(glm::abs(normal), planes_.largestCoordinate);
  }

  bool liesIn(const SupportingPlane& plane, const Face& face) const {
    return std::ranges::all_of(face.corners, [&](const glm::dvec3& corner) {
      return std::abs(glm::dot(plane.normal, corner) - plane.offset) <= roundingAlong(plane.normal);
    });
  }
  bool liesInAny(const Face& face) const {
    return std::ranges::any_of(planes_.ofFaces,
                               [&](const SupportingPlane& plane) { return liesIn(plane, face); });
  }

  void addIfSupporting(const Face& face, const glm::dvec3& normal) {
    SupportingPlane plane{normal, glm::dot(normal, face.corners[0])};
    const double limit = plane.offset + roundingAlong(normal);
    for (const std::uint32_t vertex : vertices_) {
      const double along = glm::dot(normal, glm::dvec3(mesh_.positions[vertex]));
      if (along > limit) return;
      plane.offset = std::max(plane.offset, along);
    }
    planes_.ofFaces.push_back(plane);
  }

  void findOutline(SupportingPlane& plane) const {
    std::vector<glm::dvec3> corners;
    double towards = 0.0, away = 0.0;  // area of the triangles wound to either side
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const Face face = faceOf(mesh_, t);
      if (std::abs(glm::dot(face.normal, plane.normal)) < 0.5 || !liesIn(plane, face)) continue;
      corners.insert(corners.end(), face.corners.begin(), face.corners.end());
      const double area = 0.5 * glm::dot(plane.normal, glm::cross(face.corners[1] - face.corners[0],
                                                                  face.corners[2] - face.corners[0]));
      (area > 0.0 ? towards : away) += std::abs(area);
    }
    std::vector<glm::dvec3> hull = convexPolygon(corners, plane.normal);
    double area = 0.0, perimeter = 0.0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const glm::dvec3 &a = hull[i], &b = hull[(i + 1) % hull.size()];
      area += 0.5 * glm::dot(plane.normal, glm::cross(a - hull[0], b - hull[0]));
      perimeter += glm::length(b - a);
    }
    const double rounding = kRounding * glm::length(planes_.largestCoordinate) * perimeter;
    const auto fills = [&](double covered) { return std::abs(covered - std::abs(area)) <= rounding; };
    if (hull.size() >= 3 && (fills(towards) || (planes_.planar && fills(away))))
      plane.outline = std::move(hull);
  }

  const TriangleMesh& mesh_;
  SupportingPlanes& planes_;
  std::vector<std::uint32_t> vertices_;
};
}  // namespace

SupportingPlanes supportingPlanesOf(const TriangleMesh& mesh, const glm::dvec3& recenteredBy) {
  SupportingPlanes planes;
  planes.bounds = boundsOf(mesh);
  planes.largestCoordinate =
      glm::max(glm::abs(planes.bounds.low + recenteredBy), glm::abs(planes.bounds.high + recenteredBy));
  Finder(mesh, planes).find();
  constexpr std::size_t kBlockIndices = 3 * SupportingPlanes::kBlockTriangles;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    if (i % kBlockIndices == 0) planes.blocks.emplace_back();
    planes.blocks.back().include(glm::dvec3(mesh.positions[mesh.indices[i]]));
  }
  return planes;
}

}  // namespace halfshadow::scene
