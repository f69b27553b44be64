// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The facets of a dense surface as trees of boxes in (t, i), which a fragment walks by itself. A list of a
/// tile holds a loop for each of thousands of facets that some receiver of the tile may see before the light;
/// a fragment that walks a tree meets those that it sees itself, and where a box stands before it only the
/// contour of what is in there. All lists share the trees.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace halfshadow::outlines {

struct NearSurface;

/// Depth first: a box, then what is in it. Loops are counter-clockwise around what facets cover for receivers
/// that they hide some of the light from.
struct FacetTree {
  struct Loop {
    std::uint32_t first = 0, count = 0;  ///< in `points`, closed
  };
  struct Node {
    glm::vec3 low{0.0f}, high{0.0f};  ///< bounds in (t, i)
    std::uint32_t end = 0;            ///< the node after all that is in this one
    /// In `loops`. Of a leaf: its facets, each of which counts where what it covers is positive. Else the
    /// contour of all facets in the box, for receivers farther from the light than all of it; none where it
    /// would not be shorter, or where the light lies on both sides of a facet.
    std::uint32_t firstLoop = 0, loopCount = 0;
    bool isLeaf = false;
  };
  std::vector<Node> nodes;
  std::vector<Loop> loops;
  std::vector<glm::vec3> points;  ///< (t, i)
};

/// Facets of one tree: what leads from a box to the next fits 14 bits in records (facet_tree_texels.hpp).
inline constexpr std::uint32_t kMostTreeFacets = 1024;

/// Trees of the facets whose outer side some of the light lies on, and of those whose inner side it does:
/// only a sheet's cover anything. A facet that all of the light lies on one side of hides nothing from
/// receivers on the same side, and what it covers as any of them sees it lies outside of the light: it needs
/// no test.
struct FacetTrees {
  std::vector<FacetTree> towards, away;
};
FacetTrees facetTrees(const NearSurface& surface);

}  // namespace halfshadow::outlines
