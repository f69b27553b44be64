// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Trees of facets as records beside those of lists.
#pragma once

#include <cstdint>
#include <vector>

#include "outlines/facet_tree.hpp"

namespace halfshadow::techniques {

/// A tree is a record of its centre and steps; node by node, depth first, a record of its box and, of a leaf,
/// those of its facets' vertices in strips, or of a node with a contour one that tells, in two bytes, how
/// many records after the tree's first that begins; a record that leads nowhere; then the contours, each loop
/// its vertices and the first once more. A box: the low and the high corner in 256 steps each, a byte a
/// coordinate, then in two bytes by how many records what follows all of the node lies after it, and 32768 of
/// a leaf, 16384 of another with a contour. Vertices are as in lists; byte 6 is 32 where a loop of a contour
/// starts, 1 of the last vertex of a leaf or contour, and 2 more of a strip's that turns; byte 7 of a strip's
/// is 1 where it makes no facet, 2 of a facet along, 0 of one against (facet_strips.hpp). kRecordBytes a
/// record.
std::vector<std::uint8_t> encodedTree(const outlines::FacetTree& tree);

}  // namespace halfshadow::techniques
