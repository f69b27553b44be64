// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// On which side of a closed part of a caster a point is.
#pragma once

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scene {

/// Whether the closed part goes round the point (object space), whatever shape it has.
bool enclosesPoint(const HalfEdgeMesh& mesh, const CasterPart& part, const glm::dvec3& pointObject);

enum class PartSide { outside, inside, unsure };
/// Of the closed part, the side from which a camera looks: where its near plane lies; `unsure` where the
/// part's surface may cut it.
PartSide sideSeenFrom(const HalfEdgeMesh& mesh, const CasterPart& part, const glm::dmat4& clipFromObject);

}  // namespace halfshadow::scene
