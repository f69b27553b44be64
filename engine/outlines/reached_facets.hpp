// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Facets in reach of a block of tiles, and of one of its tiles: asked for once, whatever the number of
/// sub-lights.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "outlines/facet_sides.hpp"

namespace halfshadow::outlines {

class ReachedFacets {
 public:
  /// Of surfaces whose number is less than `surfaces`.
  explicit ReachedFacets(std::size_t surfaces) : of_(surfaces) {}

  void startBlock(const TangentBox& receivers);
  /// Those in reach of the block; with more than `most`, some of them. Lasts until the next block.
  std::span<const std::uint32_t> ofBlock(const NearSurface& surface, std::size_t most);

  /// `receivers`: of a tile of the block.
  void startTile(const TangentBox& receivers);
  /// Those of the block, which are not too many, that are in reach of the tile. Lasts until it is asked for
  /// another surface, or the next tile.
  std::span<const std::uint32_t> ofTile(const NearSurface& surface);
  /// Where a part of the light lies of each of its facets; kept for all tiles.
  std::span<const FacetLight> lightsOf(const NearSurface& surface, std::size_t part, const SubLight& light);
  /// Whether anything of the surface is in reach of the tile.
  bool reachesTile(const NearSurface& surface) const {
    return isInReach(surface.low, surface.high, wholeOfTile_, tileBox_);
  }

  std::uint64_t facetTests() const { return facetTests_; }  ///< of facets against tiles, so far

 private:
  struct Box {
    glm::vec3 low, high;
  };
  struct OfSurface {
    std::uint64_t block = 0, tile = 0;  ///< that what follows is of
    std::vector<std::uint32_t> facets;  ///< of the block
    std::vector<Box> boxes;             ///< of each, side by side; none yet where no tile asked for them
    std::size_t firstOfTile = 0, ofTile = 0;  ///< in `tileFacets_`
    std::array<std::vector<FacetLight>, kSubLights> lights;
  };
  std::vector<OfSurface> of_;  ///< by number of the surface
  std::vector<std::uint32_t> tileFacets_;
  std::uint64_t block_ = 0, tile_ = 0;
  TangentBox blockBox_, tileBox_;
  OuterSides wholeOfTile_{kWholeLight, {}};
  std::uint64_t facetTests_ = 0;
};

}  // namespace halfshadow::outlines
