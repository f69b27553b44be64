// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/technique.hpp"

#include <algorithm>

namespace halfshadow::techniques {

gl::Cull hiddenFaces(const DrawItem& item, const glm::dvec3& eyeWorld, double nearReach) {
  const bool inside = glm::all(glm::greaterThanEqual(eyeWorld, item.boundsWorld.low - nearReach)) &&
                      glm::all(glm::lessThanEqual(eyeWorld, item.boundsWorld.high + nearReach));
  if (!item.closed || inside) return gl::Cull::none;
  return item.mirrored ? gl::Cull::front : gl::Cull::back;
}

glm::dmat4 heightFromWorld(const LightFrame& frame) {
  glm::dmat4 rows;
  for (int column = 0; column < 4; ++column)
    rows[column] = glm::dvec4(frame.fit.lightFromWorld[column].z / frame.fit.nearDistance);
  return rows;
}

std::span<const scene::PlacedCaster> placedCasters(const LightFrame& frame) {
  if (frame.groups.holds(frame.contentKey)) return frame.groups.placed();
  std::vector<scene::SceneCaster> casters;
  for (const DrawItem& item : frame.casters) {
    casters.push_back({.mesh = item.sourceMesh,
                       .geometry = item.geometry,
                       .worldFromObject = item.worldFromObject,
                       .revision = item.revision});
  }
  frame.groups.update(casters, frame.contentKey);
  return frame.groups.placed();
}

std::uint32_t placedCasterOf(const LightFrame& frame, const DrawItem& receiver) {
  const auto found = std::ranges::find(frame.casters, receiver.geometry, &DrawItem::geometry);
  if (found == frame.casters.end()) return kNoCaster;
  placedCasters(frame);
  return frame.groups.placedOf(static_cast<std::size_t>(found - frame.casters.begin()));
}

FilterSkip filterSkipFromName(std::string_view name) {
  if (name == "branch") return FilterSkip::branch;
  return name == "loop" ? FilterSkip::loop : FilterSkip::stencil;
}

}  // namespace halfshadow::techniques
