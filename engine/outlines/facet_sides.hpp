// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where the light and the receivers of a tile stand of a caster's facets, and which of these can matter to
/// them.
#pragma once

#include "outlines/near_surface.hpp"
#include "outlines/outer_sides.hpp"

namespace halfshadow::outlines {

/// Which facets stand for the caster. Of a closed surface every ray from a receiver to the light leaves as
/// often as it enters: those through which rays leave cover everything once.
enum class FacetChoice {
  /// Those that look at the sub-light, as its silhouettes have it. Of a closed surface's that look at some of
  /// it alone, those that receivers are behind of.
  asLightSees,
  asReceiversSee,  ///< those that receivers are behind of: exact for every point of the light
};

/// Working memory of what is asked about surfaces, of one thread at a time.
struct SideMemory {
  struct Side {
    std::uint64_t tile = 0;
    int side = 0;  ///< 1 all outside, -1 all inside, 0 some on either, kOwnFacet
  };
  struct OfSurface {
    /// On which side of each facet the receivers of a tile lie, asked for by each sub-light.
    std::vector<Side> sides;
    /// A facet that some receivers were all outside of. Their neighbours mostly are, too.
    std::uint32_t separator = 0;
  };
  std::vector<OfSurface> of;  ///< by number of the surface
  std::uint64_t tile = 0;     ///< a number of its own for each set of receivers with patches
};

/// Receivers that share a list.
struct ReceiverSet {
  const TangentBox& box;
  const ListSpace& space;
  SideMemory& memory;
  /// Their facets where they are few and known exactly; else empty.
  std::span<const ReceiverPatch> patches{};
};

/// Where a part of the light lies of a facet's plane: 1 all on its outer side, -1 all on the inner, 0 some on
/// either.
int lightSideOf(const NearSurface::Facet& facet, const SubLight& light);

/// Where a part of the light lies of one facet; the same for all receivers.
struct FacetLight {
  std::int8_t side = 0;  ///< as lightSideOf() tells
  bool sees = false;     ///< its centre is on the facet's outer side
};
std::vector<FacetLight> facetLights(const NearSurface& surface, const SubLight& light);

/// Which facets of a sheet are meant: those that look towards the centre of the light's part, or away.
enum class SheetSide { both, towards, away };

/// Facets that can cover some of the light for some receiver in the box, or more; stops when there are more
/// than `most`. Replaces `result`.
void facetsInReach(const NearSurface& surface, const TangentBox& receivers,
                   std::vector<std::uint32_t>& result, std::size_t most = ~std::size_t{0});

/// Whether what lies within the bounds can cover some of the light for some of the receivers.
/// `whole`: of the whole light and them.
inline bool isInReach(const glm::vec3& low, const glm::vec3& high, const OuterSides& whole,
                      const TangentBox& receivers) {
  return high.z > receivers.iLow && whole.code(low, high) == 0;
}

/// Of `candidates` (facets), those that can cover some of the light's part for some of the receivers.
/// `lights`: of that part and all of the surface's facets; `sides`: of it and the receivers. Replaces
/// `result`.
void facetsThatMatter(const NearSurface& surface, std::span<const std::uint32_t> candidates, SheetSide side,
                      const SubLight& light, std::span<const FacetLight> lights, const ReceiverSet& receivers,
                      const OuterSides& sides, FacetChoice choice, std::vector<std::uint32_t>& result);

/// Where receivers stand of a closed convex surface; `outside` also of one that is not, or was cut.
enum class Interior { inside, outside, unknown };
Interior interiorOf(const NearSurface& surface, const TangentBox& receivers, SideMemory& memory);
/// Whether all of the light's part lies outside of it.
bool hidesFromInside(const NearSurface& surface, const SubLight& light);

/// What a convex surface hides of a part of the light from receivers on it: what lies behind their own facet.
enum class OwnHorizon {
  unknown,  ///< it is not convex, or not all of its caster
  before,   ///< nothing: the light is before all of them
  behind,   ///< all of it
  across    ///< it is neither for all of them
};
OwnHorizon ownHorizon(const NearSurface& surface, const SubLight& light, const ReceiverSet& receivers);
/// Whether the centre of the light's part is on the facet's outer side.
bool sees(const NearSurface::Facet& facet, const SubLight& light);
/// On which side of facet `f` all receivers are: 1 outside, -1 inside, 0 some on either, or kOwnFacet. Kept
/// in their memory for receivers that have patches.
int sideOfReceivers(const NearSurface& surface, std::uint32_t f, const ReceiverSet& receivers);

}  // namespace halfshadow::outlines
