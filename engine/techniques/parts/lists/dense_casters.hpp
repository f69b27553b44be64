// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Casters of so many triangles that their outlines cost more than a frame should.
#pragma once

#include <optional>

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

/// `pcss-mip`, with the reason, where parts that are not convex have more triangles in all than setting
/// outline_triangles; or what stands in for that technique itself. For techniques that walk outlines and, on
/// casters themselves, trees of facets: both take time with the triangles, on the CPU and a fragment.
std::optional<StandIn> standInForDenseCasters(const LightScene& scene);

}  // namespace halfshadow::techniques
