// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/own_receivers.hpp"

#include <algorithm>

namespace halfshadow::techniques {

Result<ReceiverShading> withOwnReceivers(Result<ReceiverShading> shading, const LightFrame& frame,
                                         LightLists& lists, std::string_view tilesKey,
                                         std::span<const outlines::SubLight> subLights, OwnSurfaces which) {
  if (!shading) return shading;
  const auto needsNone = [which](const scene::CasterPart& part) {
    return part.convex && which == OwnSurfaces::hollow;
  };
  const bool some = std::ranges::any_of(frame.receivers, [&](const DrawItem& item) {
    const std::uint32_t own = placedCasterOf(frame, item);
    return own != kNoCaster && !std::ranges::all_of(placedCasters(frame)[own].mesh->parts(), needsNone);
  });
  if (!some) return shading;
  const ListRequest request{.subLights = subLights,
                            .receivers = ListedReceivers::casting,
                            .tiles = frame.settings.integer(tilesKey),
                            .tilesKey = tilesKey};
  if (Status s = lists.update(frame, request); !s) return s.error();
  lists.provide(frame, *shading);
  return shading;
}

}  // namespace halfshadow::techniques
