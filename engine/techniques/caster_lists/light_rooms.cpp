// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/caster_lists/light_rooms.hpp"

#include <algorithm>

#include "scene/enclosure.hpp"

namespace halfshadow::techniques {
namespace {
/// Seen from outside, it hides what is inside.
bool isDrawn(const LightFrame& frame, std::uint32_t placed) {
  for (std::size_t i = 0; i < frame.casters.size(); ++i) {
    if (frame.groups.placedOf(i) == placed && !frame.casters[i].receives) return false;
  }
  return true;
}
}  // namespace

std::vector<RoomPart> partsSeenInside(const LightFrame& frame) {
  std::vector<RoomPart> seen;
  const std::span<const scene::PlacedCaster> casters = placedCasters(frame);
  for (std::uint32_t object = 0; object < casters.size(); ++object) {
    const scene::PlacedCaster& caster = casters[object];
    const glm::dmat4 clipFromObject = frame.view.clipFromWorld * caster.worldFromObject;
    for (std::uint32_t part = 0; part < caster.mesh->parts().size(); ++part) {
      const scene::CasterPart& own = caster.mesh->parts()[part];
      if (!own.closed) continue;
      // Gaps that were filled are filled for the light, not for the eye.
      const bool hidesInside = own.filledGaps == 0 && isDrawn(frame, object) &&
                               sideSeenFrom(*caster.mesh, own, clipFromObject) == scene::PartSide::outside;
      if (!hidesInside) seen.push_back({object, part});
    }
  }
  return seen;
}

bool lightIsInRoom(const LightFrame& frame) {
  return std::ranges::any_of(partsSeenInside(frame), [&](const RoomPart& room) {
    const scene::PlacedCaster& caster = placedCasters(frame)[room.object];
    const glm::dvec3 center(glm::inverse(caster.worldFromObject) * glm::dvec4(frame.light.centerWorld, 1.0));
    return scene::enclosesPoint(*caster.mesh, caster.mesh->parts()[room.part], center);
  });
}

std::optional<StandIn> standInForRooms(const LightFrame& frame) {
  if (!lightIsInRoom(frame)) return std::nullopt;
  return StandIn{"sampled",
                 "light-in-room: the light is inside a closed caster, whose silhouette does not tell what it "
                 "hides from what stands inside"};
}

}  // namespace halfshadow::techniques
