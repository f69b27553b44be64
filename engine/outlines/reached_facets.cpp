// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/reached_facets.hpp"

namespace halfshadow::outlines {

void ReachedFacets::startBlock(const TangentBox& receivers) {
  ++block_;
  blockBox_ = receivers;
}

std::span<const std::uint32_t> ReachedFacets::ofBlock(const NearSurface& surface, std::size_t most) {
  OfSurface& of = of_[surface.number];
  if (of.block != block_) {
    of.block = block_;
    facetsInReach(surface, blockBox_, of.facets, most);
    of.boxes.clear();
  }
  return of.facets;
}

void ReachedFacets::startTile(const TangentBox& receivers) {
  ++tile_;
  tileBox_ = receivers;
  wholeOfTile_ = OuterSides(kWholeLight, receivers);
  tileFacets_.clear();
}

std::span<const std::uint32_t> ReachedFacets::ofTile(const NearSurface& surface) {
  OfSurface& of = of_[surface.number];
  if (of.tile != tile_) {
    of.tile = tile_;
    of.firstOfTile = tileFacets_.size();
    facetTests_ += of.facets.size();
    if (of.boxes.empty()) {
      for (const std::uint32_t f : of.facets)
        of.boxes.push_back({surface.facets[f].low, surface.facets[f].high});
    }
    for (std::size_t k = 0; k < of.boxes.size(); ++k) {
      if (isInReach(of.boxes[k].low, of.boxes[k].high, wholeOfTile_, tileBox_))
        tileFacets_.push_back(of.facets[k]);
    }
    of.ofTile = tileFacets_.size() - of.firstOfTile;
  }
  return std::span(tileFacets_).subspan(of.firstOfTile, of.ofTile);
}

std::span<const FacetLight> ReachedFacets::lightsOf(const NearSurface& surface, std::size_t part,
                                                    const SubLight& light) {
  std::vector<FacetLight>& lights = of_[surface.number].lights[part];
  if (lights.empty()) lights = facetLights(surface, light);
  return lights;
}

}  // namespace halfshadow::outlines
