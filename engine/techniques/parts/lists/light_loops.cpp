// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/light_loops.hpp"

#include <algorithm>
#include <cmath>

#include "base/keys.hpp"
#include "outlines/enclosed_casters.hpp"
#include "techniques/core/light_rooms.hpp"

namespace halfshadow::techniques {
namespace {
/// A point light counts as a square this wide, in units of the distance to the nearest caster's middle. What
/// single precision makes of a receiver's place is not much less.
constexpr double kMinHalfLength = 2e-6;
/// The same for half precision.
constexpr double kMinHalfLengthOfHalves = 1e-4;
/// In half sides of the light.
constexpr double kNearestCut = 1e-3;
/// Casters that lie within so much of their middle's height have it for the origin of (t, i).
constexpr double kShallow = 0.25;
/// Only what lies so near to the light, against the nearest caster, has a say in that origin: about a world
/// between two casters neither would be known well.
constexpr double kOriginReach = 8.0;

/// No caster that is far away, or wide, makes this larger.
double nearestDistance(std::span<const DrawItem> casters, const glm::dvec3& lightCenterWorld) {
  double nearest = 1e300;
  for (const DrawItem& caster : casters) {
    const glm::dvec3 middle = caster.boundsWorld.center() - lightCenterWorld;
    nearest = std::min(nearest, std::max(glm::length(middle), caster.boundsWorld.radius()));
  }
  return nearest;
}

outlines::ListSpace spaceOf(const scene::LightPlane& plane, std::span<const DrawItem> casters,
                            double nearest) {
  outlines::ListSpace space(plane);
  const scene::Bounds near{plane.centerWorld - kOriginReach * nearest,
                           plane.centerWorld + kOriginReach * nearest};
  glm::dvec3 low(1e300), high(-1e300);
  for (const DrawItem& caster : casters) {
    const scene::Bounds box{glm::max(caster.boundsWorld.low, near.low),
                            glm::min(caster.boundsWorld.high, near.high)};
    if (!glm::all(glm::lessThanEqual(box.low, box.high))) continue;
    for (const glm::dvec3& corner : box.corners()) {
      low = glm::min(low, plane.fromWorld(corner));
      high = glm::max(high, plane.fromWorld(corner));
    }
  }
  const glm::dvec3 middle = 0.5 * (low + high);
  if (!(high.z - middle.z <= kShallow * middle.z)) return space;
  space.originT = glm::dvec2(middle) / middle.z;
  space.originI = 1.0 / middle.z;
  return space;
}
}  // namespace

void LightLoops::update(const LightScene& scene, PassPlan& plan,
                        std::span<const outlines::SubLight> subLights) {
  const std::vector<outlines::RoomPart> seenInside = partsSeenInside(scene);
  std::uint64_t key = combineKeys(scene.contentKey, scene.settings.revision());
  for (const outlines::RoomPart& room : seenInside)
    key = combineKeys(key, (std::uint64_t{room.object} << 32) + room.part + 1);
  if (key_ == key && silhouettes_.size() == subLights.size()) return;
  ++generation_;
  key_ = key;
  // A power of two: casters that move about must not change the coordinates of the others.
  const double unit = std::exp2(std::ceil(std::log2(scene.fit().farDistance)));
  const double share =
      scene.capabilities.has(device::Capability::highp) ? kMinHalfLength : kMinHalfLengthOfHalves;
  const double nearest = nearestDistance(scene.casters, scene.light.centerWorld);
  space_ = spaceOf(scene::LightPlane(scene.light, unit, share * nearest), scene.casters, nearest);
  const scene::LightPlane& plane = space_.plane;
  minHeight_ = kNearestCut * std::min(glm::length(plane.halfU), glm::length(plane.halfV)) / unit;
  const std::span<const scene::PlacedCaster> casters = placedCasters(scene);
  const std::vector<bool> enclosed = outlines::enclosedCasters(casters, scene.light);
  std::vector<scene::PlacedCaster> shown;
  for (std::size_t k = 0; k < casters.size(); ++k) {
    if (!enclosed[k]) shown.push_back(casters[k]);
  }
  if (shown.size() < casters.size()) {
    plan.note(std::to_string(casters.size() - shown.size()) + " casters of " + scene.name,
              "they lie inside another caster, which hides all that they hide");
  }
  subLights_.clear();
  silhouettes_.resize(subLights.size());
  for (std::size_t i = 0; i < subLights.size(); ++i) {
    const outlines::SubLight& subLight = subLights[i];
    subLights_.push_back(
        outlines::loopsOf(silhouettes_[i].update(scene.silhouettes, shown, plane, subLight.center.x,
                                                 subLight.center.y, minHeight_, scene::LayerSplit::alongside),
                          casters, subLight, space_, seenInside));
  }
}

}  // namespace halfshadow::techniques
