// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Groups of faces that look about the same way (internal to engine/scene).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scene {

/// Most faces a cluster holds. Smaller ones are undecided less often but each costs a test; on a sphere of
/// 762 faces 16 took the least time.
inline constexpr std::uint32_t kClusterFaces = 16;

/// An order of `faces` in which each run of kClusterFaces is close in place and normal.
std::vector<std::uint32_t> clusterOrder(std::span<const glm::uvec3> faces,
                                        std::span<const glm::vec3> positions);

/// Cone of normals and offsets of the cluster's faces. `planes`: all faces' unit planes relative to `origin`.
void fitCluster(FaceCluster& cluster, std::span<const glm::uvec3> faces, std::span<const glm::vec3> positions,
                std::span<const glm::vec4> planes, const glm::dvec3& origin);

}  // namespace halfshadow::scene
