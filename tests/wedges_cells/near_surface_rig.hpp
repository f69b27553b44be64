// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Lists of faces for receivers among a caster's own surfaces against rays.
#pragma once

#include "outlines/tile_lists.hpp"
#include "scene/mesh.hpp"

namespace halfshadow::test {

/// A closed surface around the origin with hollows as deep as half its radius.
scene::TriangleMesh bumpyBall(int slices, int stacks);
/// An open sheet with folds, side x side quadrilaterals.
scene::TriangleMesh bentSheet(int side);

enum class Surface { closed, open };

/// How often the segment leaves the closed surface through one of its triangles, or meets one of the open.
int exits(const scene::TriangleMesh& mesh, Surface surface, const glm::dvec3& from, const glm::dvec3& to);

struct Deviation {
  double largest = 0.0, square = 0.0;
  int receivers = 0, penumbra = 0;
  std::size_t trees = 0;    ///< that lists lead into
  std::size_t longest = 0;  ///< records of a list
};

/// What lists of a surface for its own tiles, seen from `lights`, cost.
struct ListCost {
  std::uint64_t facetTests = 0;
  std::size_t tiles = 0, facets = 0, records = 0;
};
ListCost ownListCost(const scene::TriangleMesh& shape, double lightHalf,
                     std::span<const outlines::SubLight> lights);

/// Where (t, i) are counted from.
enum class Origin { light, caster };

/// All that lists of a surface for its own tiles, and what they lead into, say.
std::vector<double> ownListNumbers(const scene::TriangleMesh& shape, double lightHalf, Surface surface,
                                   std::size_t mostOwnFacets, const Workers& workers);

/// Of what lists say about a place in each facet that the light reaches, from what 256 rays to the light say.
/// `mostOwnFacets`: as in outlines::ListedReceiver.
Deviation deviation(const scene::TriangleMesh& shape, double lightHalf, unsigned seed,
                    Origin origin = Origin::light, Surface surface = Surface::closed,
                    std::size_t mostOwnFacets = ~std::size_t{0});

/// Two walls on y = 0 that meet at a right angle, turned about y: closed, not convex.
scene::TriangleMesh angleIron(float turn);

/// The same for a ground that the surface all but stands on, at places near its walls' feet that are not
/// behind all of it.
Deviation deviationAtFoot(const scene::TriangleMesh& shape, double lightHalf, unsigned seed,
                          std::span<const outlines::SubLight> lights);

}  // namespace halfshadow::test
