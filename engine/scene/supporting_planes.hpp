// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Planes that a mesh lies behind: with them it is shown that one object cannot come between another and a
/// light.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/bounds.hpp"
#include "scene/mesh.hpp"

namespace halfshadow::scene {

/// dot(normal, p) <= offset for every vertex p; normal is unit.
struct SupportingPlane {
  glm::dvec3 normal{0, 1, 0};
  double offset = 0.0;
  /// Corners, in order, of what the mesh covers in this plane, where that is one convex polygon without holes
  /// and the mesh is flat or convex; else empty. What is seen through it is the mesh.
  std::vector<glm::dvec3> outline;
};

struct SupportingPlanes {
  std::vector<SupportingPlane> ofFaces;  ///< a few, of the largest faces
  Bounds bounds;                         ///< object space; its six sides support the mesh too
  /// All faces lie in one plane (then `ofFaces` holds both its sides), or
  bool planar = false;
  /// they bound a convex body and each of them lies in one of `ofFaces`.
  bool convex = false;
  /// Of each kBlockTriangles triangles that follow each other: most are passed over by their box.
  std::vector<Bounds> blocks;
  static constexpr std::size_t kBlockTriangles = 64;
  /// Largest coordinates along each axis, as the host gave them: their rounding is what planes are sure to.
  glm::dvec3 largestCoordinate{0.0};
};

/// `recenteredBy`: what recenter() took off the positions. A face counts as in a plane, and a vertex as
/// behind it, within the rounding of the coordinates to float.
SupportingPlanes supportingPlanesOf(const TriangleMesh& mesh, const glm::dvec3& recenteredBy);

}  // namespace halfshadow::scene
