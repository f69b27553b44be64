// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Outlines with as many vertices as the light's share tells apart where receivers stand.
#pragma once

#include "outlines/caster_loops.hpp"

namespace halfshadow::outlines {

/// Leaves out vertices of loops all of which lies before every receiver of the box. `mostShare`: of the whole
/// light, by about how much what a loop covers of it may change for any of them, all of it or any stretch of
/// its edges: what one loses the next gain. 0 leaves all as they are.
void dropDetail(CasterLoops& loops, const TangentBox& receivers, double mostShare);

}  // namespace halfshadow::outlines
