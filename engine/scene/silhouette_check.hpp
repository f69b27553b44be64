// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Proof that a silhouette is what its definition says. Slow; for tests and for files under suspicion.
#pragma once

#include <string>

#include "scene/half_edge_mesh.hpp"

namespace halfshadow::scene {

/// What is wrong with `silhouette`, a result of extractSilhouette() on `mesh`; empty when all is well: every
/// loop has at least three vertices, and the loops of each entry run, as often as they should and nowhere
/// else, along the boundary of the entry's faces as added up face by face.
std::string silhouetteProblem(const HalfEdgeMesh& mesh, const Silhouette& silhouette);

}  // namespace halfshadow::scene
