// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What leads from a list into trees of facets.
#pragma once

#include <cstdint>
#include <vector>

#include "outlines/near_surface.hpp"
#include "outlines/tile_lists.hpp"

namespace halfshadow::outlines {

/// A surface whose trees stand for it, for sub-lights that have a bit.
struct TreeCall {
  const NearSurface* surface = nullptr;
  std::uint8_t subLights = 0;
};

/// Adds `subLights` to those of the surface's call.
void callTrees(const NearSurface& surface, std::uint8_t subLights, std::vector<TreeCall>& calls);

/// Puts what leads into the trees that are in reach of the receivers before the records from `first` on; how
/// many surfaces have some.
std::size_t insertTrees(const std::vector<TreeCall>& calls, const TangentBox& receivers, std::size_t first,
                        NearSurfaces& surfaces, TileLists& lists);

}  // namespace halfshadow::outlines
