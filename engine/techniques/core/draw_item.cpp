// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/draw_item.hpp"

namespace halfshadow::techniques {
namespace {
constexpr std::uint32_t kFewTriangles = 256;
}  // namespace

device::Cull hiddenFaces(const DrawItem& item, const glm::dvec3& eyeWorld, double nearReach) {
  const bool inside = glm::all(glm::greaterThanEqual(eyeWorld, item.boundsWorld.low - nearReach)) &&
                      glm::all(glm::lessThanEqual(eyeWorld, item.boundsWorld.high + nearReach));
  if (!item.closed || inside) return device::Cull::none;
  return item.mirrored ? device::Cull::front : device::Cull::back;
}

device::Cull unseenFaces(const DrawItem& item, const glm::dvec3& eyeWorld, double nearReach) {
  if (!item.frontOnly) return hiddenFaces(item, eyeWorld, nearReach);
  return item.mirrored ? device::Cull::front : device::Cull::back;
}

bool needsFacetStream(const device::Capabilities& capabilities) {
  return !capabilities.has(device::Capability::derivatives) || !capabilities.has(device::Capability::highp);
}

bool hasFewTriangles(const DrawItem& item) {
  return item.sourceMesh->triangleCount() <= kFewTriangles;
}

device::Cull turnedRound(device::Cull faces) {
  if (faces == device::Cull::none) return faces;
  return faces == device::Cull::back ? device::Cull::front : device::Cull::back;
}

}  // namespace halfshadow::techniques
