// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/light_rooms.hpp"

#include <algorithm>

#include "scene/enclosure.hpp"

namespace halfshadow::techniques {
namespace {
/// By placed caster: seen from outside, it hides what is inside.
std::vector<bool> drawnCasters(const LightScene& scene, std::size_t placedCount) {
  std::vector<bool> drawn(placedCount, true);
  for (std::size_t i = 0; i < scene.casters.size(); ++i) {
    if (!scene.casters[i].receives) drawn[scene.groups.placedOf(i)] = false;
  }
  return drawn;
}
}  // namespace

std::vector<outlines::RoomPart> partsSeenInside(const LightScene& scene) {
  std::vector<outlines::RoomPart> seen;
  const std::span<const scene::PlacedCaster> casters = placedCasters(scene);
  const std::vector<bool> drawn = drawnCasters(scene, casters.size());
  for (std::uint32_t object = 0; object < casters.size(); ++object) {
    const scene::PlacedCaster& caster = casters[object];
    const glm::dmat4 clipFromObject = scene.screen.clipFromWorld * caster.worldFromObject;
    for (std::uint32_t part = 0; part < caster.mesh->parts().size(); ++part) {
      const scene::CasterPart& own = caster.mesh->parts()[part];
      if (!own.closed) continue;
      // Gaps that were filled are filled for the light, not for the eye.
      const bool hidesInside = own.filledGaps == 0 && drawn[object] &&
                               sideSeenFrom(*caster.mesh, own, clipFromObject) == scene::PartSide::outside;
      if (!hidesInside) seen.push_back({object, part});
    }
  }
  return seen;
}

bool lightIsInRoom(const LightScene& scene) {
  return std::ranges::any_of(partsSeenInside(scene), [&](const outlines::RoomPart& room) {
    const scene::PlacedCaster& caster = placedCasters(scene)[room.object];
    const glm::dvec3 center(glm::inverse(caster.worldFromObject) * glm::dvec4(scene.light.centerWorld, 1.0));
    return scene::enclosesPoint(*caster.mesh, caster.mesh->parts()[room.part], center);
  });
}

std::optional<StandIn> standInForRooms(const LightScene& scene) {
  if (!lightIsInRoom(scene)) return std::nullopt;
  return StandIn{"sampled",
                 "light-in-room: the light is inside a closed caster, whose silhouette does not tell what it "
                 "hides from what stands inside"};
}

}  // namespace halfshadow::techniques
