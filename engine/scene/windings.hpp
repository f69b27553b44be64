// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Windings mended once, in the mesh itself (internal to engine/scene): drawing, culling and silhouettes all
/// read the mended ones.
#pragma once

#include "scene/edge_uses.hpp"
#include "scene/mesh.hpp"

namespace halfshadow::scene {

/// Finds the mesh's closed shells and turns their triangles so that neighbours agree and each shell is wound
/// outward: seen from outside it its front faces come first, so that culling back faces hides nothing.
///
/// A shell is a set of triangles that are connected across edges of exactly two triangles, can be wound
/// alike, and has no border. A shell inside another one (the wall of a cavity) is wound outward too: from
/// outside both it is hidden by the outer one whatever its winding, and seen from within nothing is culled,
/// because culling asks whether the eye is inside the object's box. What is open or cannot be oriented stays
/// as it is. `uses` are of mesh.indices, by welded vertex. Sets shellOf, shellCount and turned.
void mendWindings(TriangleMesh& mesh, std::span<const EdgeUse> uses);

}  // namespace halfshadow::scene
