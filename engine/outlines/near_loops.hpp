// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The loops that stand for a caster's facets in the list of receivers among its surfaces.
#pragma once

#include "outlines/facet_sides.hpp"

namespace halfshadow::outlines {

/// Loops of `facets`: first around those that stand before all receivers (and, of a convex caster, those
/// among them), joined; then around each of the others; then around each of those that cover only for
/// receivers on their inner side, of which there are some on either: a fragment counts them where what they
/// cover is positive.
struct NearLoops {
  struct Loops {
    std::vector<glm::vec3> points;
    std::vector<std::size_t> ends;  ///< of each loop, in `points`
    void clear() { points.clear(), ends.clear(); }
    void forEach(auto&& use) const {
      std::size_t first = 0;
      for (const std::size_t end : ends) {
        use(std::span(points).subspan(first, end - first));
        first = end;
      }
    }
  };
  Loops joined, among, oneSided;
};
/// Working memory of nearLoops(), for any surface: between uses all links are -1, all roles 0.
struct NearLoopScratch {
  struct Link {
    std::uint32_t to = 0;
    std::int32_t next = -1;
  };
  std::vector<std::int32_t> firstLink;  ///< by point
  std::vector<Link> links;
  std::vector<std::uint32_t> starts;
  std::vector<std::uint8_t> roles;  ///< by facet
};
void nearLoops(const NearSurface& surface, std::span<const std::uint32_t> facets, const SubLight& light,
               const ReceiverSet& receivers, FacetChoice choice, NearLoopScratch& scratch, NearLoops& result);

}  // namespace halfshadow::outlines
