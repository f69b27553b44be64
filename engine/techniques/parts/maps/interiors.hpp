// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Rooms that the light is outside of: where a wall meets the one that hides it from the light, a blur of
/// fixed width reaches past their common edge into the open.
#pragma once

#include <optional>

#include "techniques/core/light_scene.hpp"

namespace halfshadow::techniques {

/// `sampled`, with the reason, when the eye is inside a closed caster that the light's centre is outside of,
/// or when a wall of an open one hides another from the light that it meets, as in a room.
std::optional<StandIn> standInForInteriors(const LightScene& scene);

/// Does the closed mesh part the two points, in the space of its positions? By the parity of its triangles
/// that the segment between them passes.
bool parts(const scene::TriangleMesh& mesh, const glm::dvec3& from, const glm::dvec3& to);

}  // namespace halfshadow::techniques
