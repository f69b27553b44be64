// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/last_receivers.hpp"

#include <algorithm>
#include <limits>
#include <unordered_set>

#include "base/keys.hpp"

namespace halfshadow::techniques {
namespace {
/// Share of the map from which on a caster counts as a ground: smaller ones cost as little as they change.
constexpr double kLeastShare = 1.0 / 16.0;

/// A box as the light's centre sees it: tangents and distances along the axis.
struct SeenBox {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

SeenBox seenBox(const planner::LightFit& fit, const scene::Bounds& boundsWorld) {
  SeenBox seen;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 world(corner & 1 ? boundsWorld.high.x : boundsWorld.low.x,
                           corner & 2 ? boundsWorld.high.y : boundsWorld.low.y,
                           corner & 4 ? boundsWorld.high.z : boundsWorld.low.z);
    const glm::dvec3 p = glm::dvec3(fit.lightFromWorld * glm::dvec4(world, 1.0));
    // What reaches behind the near plane may be seen in any direction.
    const double z = std::max(p.z, fit.nearDistance);
    const glm::dvec3 at(p.x / z, p.y / z, p.z);
    seen.low = glm::min(seen.low, at);
    seen.high = glm::max(seen.high, at);
  }
  return seen;
}

bool isBefore(const SeenBox& caster, const SeenBox& ground) {
  const bool inside = caster.low.x > ground.low.x && caster.low.y > ground.low.y &&
                      caster.high.x < ground.high.x && caster.high.y < ground.high.y;
  return inside && caster.low.z < ground.high.z;
}

/// Seen over a part of the map that other casters can lie before.
bool isLarge(const SeenBox& seen, const planner::LightFit& fit) {
  const glm::dvec2 extent =
      glm::min(glm::dvec2(seen.high), fit.tangentHigh) - glm::max(glm::dvec2(seen.low), fit.tangentLow);
  const glm::dvec2 map = fit.tangentHigh - fit.tangentLow;
  return extent.x > 0.0 && extent.y > 0.0 && extent.x * extent.y >= kLeastShare * map.x * map.y;
}

/// False only where isLarge() is: a bound from the ball around the box, for the many that are small.
bool mayBeLarge(const planner::LightFit& fit, const scene::Bounds& boundsWorld) {
  const double radius = boundsWorld.radius();
  const glm::dvec3 center = glm::dvec3(fit.lightFromWorld * glm::dvec4(boundsWorld.center(), 1.0));
  const double nearest = center.z - radius;
  if (!(nearest > fit.nearDistance)) return true;
  const glm::dvec2 extent =
      2.0 * radius / nearest * (1.0 + glm::abs(glm::dvec2(center)) / (center.z + radius));
  const glm::dvec2 map = fit.tangentHigh - fit.tangentLow;
  constexpr double kRounding = 1e-9;
  return extent.x * extent.y * (1.0 + kRounding) >= kLeastShare * map.x * map.y;
}
}  // namespace

glm::dmat4 almostInfinitelyFar(const glm::dmat4& clipFromWorld) {
  constexpr double kDepthOverW = 1.0 - 1e-6;
  glm::dmat4 flat = clipFromWorld;
  for (int column = 0; column < 4; ++column) flat[column][2] = kDepthOverW * flat[column][3];
  return flat;
}

LastReceivers lastReceivers(const LightScene& scene) {
  LastReceivers last;
  if (std::ranges::none_of(scene.casters, [&](const DrawItem& caster) {
        return caster.receives && mayBeLarge(scene.fit(), caster.boundsWorld);
      }))
    return last;
  std::vector<SeenBox> seen;
  for (const DrawItem& caster : scene.casters) seen.push_back(seenBox(scene.fit(), caster.boundsWorld));
  std::vector<char> grounds(seen.size(), 0);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const DrawItem& caster = scene.casters[i];
    if (!caster.receives || !isLarge(seen[i], scene.fit())) continue;
    // From within, the faces that face the light are a roof, behind which others receive.
    const bool seenFromWithin =
        hiddenFaces(caster, scene.screen.eyeWorld, scene.screen.nearReach) == device::Cull::none;
    grounds[i] = !caster.closed || (!seenFromWithin && std::ranges::any_of(seen, [&](const SeenBox& other) {
      return isBefore(other, seen[i]);
    }));
    last.empty = last.empty && !grounds[i];
  }
  if (last.empty) return last;
  std::unordered_set<const GpuMesh*> listed;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    (grounds[i] ? last.drawn : last.infinite).push_back(scene.casters[i]);
    listed.insert(scene.casters[i].mesh);
  }
  const auto add = [&](const DrawItem& item) {
    if (listed.insert(item.mesh).second) last.drawn.push_back(item);
  };
  for (const DrawItem& item : scene.shadowlessReceivers) add(item);
  // Casters that were dropped, since they shadow nothing, receive all the same.
  for (const DrawItem& item : scene.receivers) {
    if (item.casts) add(item);
  }
  last.contentKey = scene.contentKey;
  for (const auto* list : {&last.drawn, &last.infinite}) {
    for (const DrawItem& item : *list) last.contentKey = combineKeys(last.contentKey, item.revision);
    last.contentKey = combineKeys(last.contentKey, list->size());
  }
  return last;
}

}  // namespace halfshadow::techniques
