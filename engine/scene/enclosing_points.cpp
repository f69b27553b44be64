// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/bounds.hpp"
#include "scene/convex_hull.hpp"

namespace halfshadow::scene {
namespace {
/// Up to so many corners the hull itself is taken: real models have a few hundred.
constexpr std::size_t kMostCorners = 4096;
/// Planes around a hull of more: their corners are twice as many.
constexpr int kPlanes = 512;
/// Rounding of corners that are where three planes meet, of their distance from the middle.
constexpr double kRounding = 1e-9;

std::vector<glm::dvec3> boxCorners(std::span<const glm::dvec3> points) {
  Bounds bounds;
  for (const glm::dvec3& point : points) bounds.include(point);
  const auto corners = bounds.corners();
  return {corners.begin(), corners.end()};
}

/// Evenly spread: a spiral of equal areas. Those of the axes first, so that boxes stay tight.
std::vector<glm::dvec3> directions() {
  std::vector<glm::dvec3> all{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < kPlanes; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kPlanes, r = std::sqrt(1.0 - z * z);
    all.emplace_back(r * std::cos(turn * i), r * std::sin(turn * i), z);
  }
  return all;
}

/// Corners of the polytope that planes around the points bound: each is a face of the hull of the planes'
/// duals. Planes are spread evenly where the points' box is a cube, so that long things are held as tightly.
std::vector<glm::dvec3> cornersAround(std::span<const glm::dvec3> points) {
  Bounds bounds;
  for (const glm::dvec3& point : points) bounds.include(point);
  const glm::dvec3 middle = bounds.center(), half = 0.5 * (bounds.high - bounds.low);
  if (glm::any(glm::lessThanEqual(half, glm::dvec3(0.0)))) return boxCorners(points);
  std::vector<glm::dvec3> duals;
  for (const glm::dvec3& normal : directions()) {
    double offset = 0.0;
    for (const glm::dvec3& point : points)
      offset = std::max(offset, glm::dot(normal, (point - middle) / half));
    if (!(offset > 0.0)) return boxCorners(points);
    duals.push_back(normal / offset);
  }
  const auto dual = convexHull(duals);
  if (!dual) return boxCorners(points);
  std::vector<glm::dvec3> corners;
  for (const HullFace& face : *dual) {
    if (!(face.offset > 0.0)) return boxCorners(points);
    corners.push_back(middle + half * (1.0 + kRounding) / face.offset * face.normal);
  }
  return corners;
}

/// Of points that convexHull() finds no volume in; a polygon where they lie in a plane.
std::vector<glm::dvec3> cornersOfFlat(const std::vector<glm::dvec3>& points) {
  const auto farthest = [&](auto distance) { return *std::ranges::max_element(points, {}, distance); };
  const glm::dvec3 a = points.front();
  const glm::dvec3 b = farthest([&](const glm::dvec3& p) { return glm::length(p - a); });
  const glm::dvec3 c = farthest([&](const glm::dvec3& p) { return glm::length(glm::cross(p - a, b - a)); });
  const glm::dvec3 cross = glm::cross(b - a, c - a);
  const double length = glm::length(cross);
  if (!(length > 0.0)) return points;
  const glm::dvec3 normal = cross / length;
  const bool flat = std::ranges::all_of(points, [&](const glm::dvec3& p) {
    return std::abs(glm::dot(p - a, normal)) <= kRounding * glm::length(b - a);
  });
  return flat ? convexPolygon(points, normal) : points;
}
}  // namespace

std::vector<glm::dvec3> usedVertices(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.positions.size(), false);
  std::vector<glm::dvec3> vertices;
  for (const std::uint32_t vertex : mesh.indices) {
    if (used[vertex]) continue;
    used[vertex] = true;
    vertices.emplace_back(mesh.positions[vertex]);
  }
  return vertices;
}

EnclosingPoints enclosingPoints(const TriangleMesh& mesh) {
  std::vector<glm::dvec3> vertices = usedVertices(mesh);
  if (vertices.size() <= 8) return {std::move(vertices), true};
  const auto hull = convexHull(vertices);
  std::vector<glm::dvec3> corners;
  if (hull) {
    std::vector<bool> isCorner(vertices.size(), false);
    for (const HullFace& face : *hull) {
      for (const std::uint32_t corner : face.corners) isCorner[corner] = true;
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (isCorner[i]) corners.push_back(vertices[i]);
    }
  } else {
    corners = cornersOfFlat(vertices);
  }
  if (corners.size() <= kMostCorners) return {std::move(corners), true};
  return {cornersAround(corners), false};
}

}  // namespace halfshadow::scene
