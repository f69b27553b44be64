// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where the light and the receivers of a tile stand of a caster's facets, and which of these can matter to
/// them.
#pragma once

#include "outlines/near_surface.hpp"

namespace halfshadow::outlines {

/// Which facets stand for the caster. Of a closed surface every ray from a receiver to the light leaves as
/// often as it enters: those through which rays leave cover everything once.
enum class FacetChoice {
  asLightSees,     ///< those that look at the sub-light's centre, as its silhouettes have it
  asReceiversSee,  ///< those that receivers are behind of: exact for every point of the light
};

/// Receivers that share a list.
struct ReceiverSet {
  const TangentBox& box;
  const ListSpace& space;
  /// Their facets where they are few and known exactly; else empty.
  std::span<const ReceiverPatch> patches;
  std::uint64_t tile = 0;  ///< a number of its own for each set with patches
};

/// Where a part of the light lies of a facet's plane: 1 all on its outer side, -1 all on the inner, 0 some on
/// either.
int lightSideOf(const NearSurface::Facet& facet, const SubLight& light);

/// Those of a sheet's facets that look towards the light's centre, or those that look away.
std::vector<std::uint32_t> facetsOfSide(const NearSurface& surface, std::span<const std::uint32_t> facets,
                                        const SubLight& light, bool turnedAway);

/// Facets that can cover some of the light for some receiver in the box, or more; stops when there are more
/// than `most`. Replaces `result`.
void facetsInReach(const NearSurface& surface, const TangentBox& receivers,
                   std::vector<std::uint32_t>& result, std::size_t most = ~std::size_t{0});

/// Of `candidates` (facets), those that can cover some of the light's part for some of the receivers.
/// Replaces `result`.
void facetsThatMatter(const NearSurface& surface, std::span<const std::uint32_t> candidates,
                      const SubLight& light, const ReceiverSet& receivers, FacetChoice choice,
                      std::vector<std::uint32_t>& result);

/// Where receivers stand of a closed convex surface; `outside` also of one that is not, or was cut.
enum class Interior { inside, outside, unknown };
Interior interiorOf(const NearSurface& surface, const TangentBox& receivers);
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
/// in the surface for receivers that have patches.
int sideOfReceivers(const NearSurface& surface, std::uint32_t f, const ReceiverSet& receivers);

}  // namespace halfshadow::outlines
