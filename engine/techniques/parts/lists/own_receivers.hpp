// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Lists for the surfaces of casters that are not convex, where a technique else draws on the screen what
/// silhouettes cover: among a caster's own surfaces that says nothing (see near_surface.hpp).
#pragma once

#include <string_view>

#include "techniques/parts/lists/light_lists.hpp"

namespace halfshadow::techniques {

/// Which casters' own surfaces need lists.
enum class OwnSurfaces {
  hollow,  ///< those that are not convex
  all      ///< a silhouette is that of one point of the light, and own facets know all others
};

/// Whether some casting receiver needs lists; then all of them have them.
bool needsOwnReceivers(const LightScene& scene, OwnSurfaces which);

/// Makes casting receivers of the plan's shading walk lists, for a fragment file that does so with
/// HS_CASTING_RECEIVER. Nothing happens where no casting receiver needs them. `tilesKey`: the setting that
/// holds the number of tiles. `subLights`: those of the fragment file. `walk`: how they do so on the screen.
/// Errors: outOfMemory (lists exceed the largest texture).
Status addOwnReceivers(const LightScene& scene, PassPlan& plan, LightLoops& loops, LightLists& lists,
                       std::string_view tilesKey, std::span<const outlines::SubLight> subLights,
                       OwnSurfaces which, const ScreenWalk& walk);

}  // namespace halfshadow::techniques
