// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

gl::Cull hiddenFaces(const DrawItem& item, const glm::dvec3& eyeWorld, double nearReach) {
  const bool inside = glm::all(glm::greaterThanEqual(eyeWorld, item.boundsWorld.low - nearReach)) &&
                      glm::all(glm::lessThanEqual(eyeWorld, item.boundsWorld.high + nearReach));
  if (!item.closed || inside) return gl::Cull::none;
  return item.mirrored ? gl::Cull::front : gl::Cull::back;
}

std::vector<scene::PlacedCaster> placedCasters(const LightFrame& frame) {
  std::vector<scene::PlacedCaster> casters;
  for (std::uint32_t i = 0; i < frame.casters.size(); ++i) {
    casters.push_back({.mesh = &frame.casters[i].halfEdges(),
                       .worldFromObject = frame.casters[i].worldFromObject,
                       .object = i,
                       .revision = frame.casters[i].revision});
  }
  return casters;
}

FilterSkip filterSkipFromName(std::string_view name) {
  if (name == "branch") return FilterSkip::branch;
  return name == "loop" ? FilterSkip::loop : FilterSkip::stencil;
}

}  // namespace halfshadow::techniques
