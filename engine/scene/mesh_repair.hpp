// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Makes casters of a heap of triangles (internal to engine/scene): what cannot be closed becomes a sheet,
/// with the reason; nothing is ever left out of the shadow.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scene {

struct RepairedPart {
  std::vector<glm::uvec3> faces;  ///< of closed parts outward
  CasterPart facts;               ///< what was found and done; ranges and bounds are not set
};

/// Connected parts of `faces` (of welded vertices). In this order:
/// - of two faces back to back one is dropped: an open part occludes from both sides anyway;
/// - vertices on open borders within 1e-6 of the mesh's size are merged;
/// - vertices on open borders that lie on another open edge split it and its face;
/// - windings are made to agree across edges of two faces;
/// - open loops that enclose next to no area (cracks), and all loops of a part when they are at most 1 % of
///   its area, are filled;
/// - shells that are closed by themselves are kept apart from what touches them along edges of more than two
///   faces; fins and inner walls become sheets;
/// - closed parts are turned outward by their signed volume.
std::vector<RepairedPart> repairParts(std::vector<glm::uvec3> faces, std::span<const glm::vec3> positions,
                                      MeshRepairs& repairs);

}  // namespace halfshadow::scene
