// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Trees of facets as records beside those of lists.
#pragma once

#include <cstdint>

#include "outlines/facet_tree.hpp"

namespace halfshadow::techniques {

/// A tree is a record of its centre and steps, then node by node, depth first, a record of its box and those
/// of its loops, each its vertices and the first once more; then a record that leads nowhere. A box: the low
/// and the high corner in 256 steps each, a byte a coordinate, then in two bytes by how many records what
/// follows all of the node lies after it, and 32768 of a leaf, 16384 of another with a contour. Before a
/// contour there is a record of its length, in two bytes. Vertices are as in lists, with a scale of 1; the
/// last of a node has the tag that ends a caster.
std::size_t recordsOf(const outlines::FacetTree& tree);

/// Writes recordsOf() · kRecordBytes bytes.
void encodeTree(const outlines::FacetTree& tree, std::uint8_t* texels);

}  // namespace halfshadow::techniques
