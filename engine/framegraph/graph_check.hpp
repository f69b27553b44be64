// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Declarations that cannot be right, whatever is cached: found before a plan is made.
#pragma once

#include "framegraph/graph.hpp"

namespace halfshadow::framegraph {

/// Errors (internal, naming the pass and the resource): an unknown id, a size of zero, a name used twice, a
/// pass without a target, targets of different sizes, a format that does not fit its attachment point, two
/// resources at one point, an imported target mixed with others, a read of something that has no texture, a
/// read and a write of one resource in one pass.
Status checkGraph(const Graph& graph);

}  // namespace halfshadow::framegraph
