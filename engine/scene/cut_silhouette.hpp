// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Silhouettes of what reaches through a light's plane (internal to engine/scene).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scene {

/// target = linear · object + offset.
struct AffineMap {
  glm::dmat3 linear{1.0};
  glm::dvec3 offset{0.0};
  glm::dvec3 operator()(const glm::vec3& p) const { return linear * glm::dvec3(p) + offset; }
  /// The z of that.
  double height(const glm::vec3& p) const {
    return linear[0].z * double(p.x) + linear[1].z * double(p.y) + linear[2].z * double(p.z) + offset.z;
  }
};

enum class HeightRange { below, through, above };
/// Where `bounds` lies in the map's z against `minHeight`; "through" when in doubt.
HeightRange heightRange(const Bounds& bounds, const AffineMap& map, double minHeight);

/// The boundary of that part of `entry`'s faces that has z >= minHeight in the map's target: the silhouette's
/// edges, cut, and the lines in which the plane cuts the faces. So a shade that hangs around a light through
/// its plane keeps its loop. Closed loops in the target, in the silhouette's sense of rotation.
void cutSilhouette(const HalfEdgeMesh& mesh, const Silhouette& silhouette, const Silhouette::Part& entry,
                   const AffineMap& map, double minHeight, std::vector<std::vector<glm::dvec3>>& loops);

}  // namespace halfshadow::scene
