// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/own_receivers.hpp"

#include <algorithm>

namespace halfshadow::techniques {

bool needsOwnReceivers(const LightScene& scene, OwnSurfaces which) {
  const auto needsNone = [which](const scene::CasterPart& part) {
    return part.convex && which == OwnSurfaces::hollow;
  };
  return std::ranges::any_of(scene.receivers, [&](const DrawItem& item) {
    const std::uint32_t own = placedCasterOf(scene, item);
    return own != kNoCaster && !std::ranges::all_of(placedCasters(scene)[own].mesh->parts(), needsNone);
  });
}

Status addOwnReceivers(const LightScene& scene, PassPlan& plan, LightLoops& loops, LightLists& lists,
                       std::string_view tilesKey, std::span<const outlines::SubLight> subLights,
                       OwnSurfaces which, const ScreenWalk& walk) {
  if (!needsOwnReceivers(scene, which)) return {};
  const ListRequest request{.subLights = subLights,
                            .receivers = ListedReceivers::casting,
                            .tiles = scene.settings.integer(tilesKey),
                            .tilesKey = tilesKey};
  if (Status s = lists.update(scene, plan, loops, request); !s) return s;
  lists.provide(scene, plan, walk);
  return {};
}

}  // namespace halfshadow::techniques
