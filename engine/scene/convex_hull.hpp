// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Convex hulls of points, in double precision.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/mesh.hpp"

namespace halfshadow::scene {

/// A triangle of a hull; dot(normal, p) <= offset for all points p.
struct HullFace {
  std::array<std::uint32_t, 3> corners{};  ///< indices of points, counter-clockwise seen from outside
  glm::dvec3 normal{0.0};                  ///< unit
  double offset = 0.0;
};
/// Nothing where the points lie in a plane, or so nearly that rounding leaves no closed surface.
std::optional<std::vector<HullFace>> convexHull(std::span<const glm::dvec3> points);

/// Corners, in order about the normal, of the hull of points in a plane.
std::vector<glm::dvec3> convexPolygon(std::vector<glm::dvec3> points, const glm::dvec3& normal);

/// Points whose convex hull holds every triangle of the mesh, object space: what bounds of it are found from
/// wherever it is placed.
struct EnclosingPoints {
  std::vector<glm::dvec3> points;
  /// They are vertices, the hull's own corners, with which bounds are those of the mesh itself. Where these
  /// are many (a fine sphere), some thousand points stand for them that lie up to 1 % outside.
  bool exact = true;
};
EnclosingPoints enclosingPoints(const TriangleMesh& mesh);
/// The vertices that triangles use, each once: the same at no effort, for meshes that change.
std::vector<glm::dvec3> usedVertices(const TriangleMesh& mesh);

}  // namespace halfshadow::scene
