// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How much of a body an open mesh is: a character without soles, or a single card.
#pragma once

#include "scene/mesh.hpp"

namespace halfshadow::scene {

/// Share of the ways just below the horizon of a point's facet, in [0, 1], that end inside the mesh: 1 for a
/// closed one, 0 for a flat card. What a light holds below the horizon is hidden by so much. Judged by rays
/// from points spread over the mesh, at most a few million tests of ray against triangle; the same for the
/// same mesh.
double solidity(const TriangleMesh& mesh);

}  // namespace halfshadow::scene
