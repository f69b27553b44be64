// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Two independent counts of how many layers of a caster lie in a direction: rays against faces, and turns
/// of the loops.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::testing {

enum class Side { towards, away };

/// Faces of the part that look to the given side and are hit by the ray from `light`; nothing when the ray
/// passes so near an edge that rounding may decide.
std::optional<int> layersByRay(const scene::HalfEdgeMesh& mesh, std::uint32_t part, const glm::dvec3& light,
                               const glm::dvec3& direction, Side side);

/// Layers in direction `from` less those in direction `to` (not opposite), from the loops alone: signed
/// crossings of the arc between them.
int layerDifference(const scene::HalfEdgeMesh& mesh, const scene::Silhouette& silhouette, std::uint32_t part,
                    const glm::dvec3& light, const glm::dvec3& from, const glm::dvec3& to, Side side);

}  // namespace halfshadow::testing
