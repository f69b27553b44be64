// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/caster_loops.hpp"

#include <algorithm>
#include <cmath>

#include "outlines/caster_clusters.hpp"

namespace halfshadow::outlines {

void CasterLoops::clear() {
  points.clear();
  loops.clear();
  low = glm::vec3(1e30f);
  high = glm::vec3(-1e30f);
  partLow = glm::vec3(-1e30f);
  partHigh = glm::vec3(1e30f);
  enclosesLight = isRoom = seenInside = false;
  deepest = 0.0f;
  firstLayer = layerCount = 0;
  layersBefore = false;
  object = part = 0;
  turnedAway = false;
  convex = true;
}

void CasterLoops::addLoop(std::span<const glm::vec3> loop) {
  loops.push_back({static_cast<std::uint32_t>(points.size()), static_cast<std::uint32_t>(loop.size())});
  points.insert(points.end(), loop.begin(), loop.end());
  for (const glm::vec3& p : loop) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
}

namespace {
/// Of single precision, and of what the loops' points were rounded to.
constexpr double kBoundsRounding = 1e-6;

/// The default where it is not wholly before the light's plane.
void boundPart(const scene::Bounds& partWorld, const ListSpace& space, CasterLoops& caster) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& corner : partWorld.corners()) {
    const glm::dvec3 abh = space.plane.fromWorld(corner);
    if (abh.z <= kBoundsRounding) return;
    const glm::dvec3 ti = space.tangentPoint(abh);
    low = glm::min(low, ti);
    high = glm::max(high, ti);
  }
  const glm::dvec3 rounding = kBoundsRounding * glm::max(glm::abs(low), glm::abs(high));
  caster.partLow = glm::vec3(low - rounding);
  caster.partHigh = glm::vec3(high + rounding);
}

/// Entries that share layers are near receivers, or behind none of them, together.
void boundTogether(std::span<CasterLoops> casters) {
  for (std::size_t first = 0, end = 0; first < casters.size(); first = end) {
    for (end = first + 1; end < casters.size() && casters[end].layersBefore;) ++end;
    const std::span<CasterLoops> entries = casters.subspan(first, end - first);
    CasterLoops& all = entries.front();
    for (const CasterLoops& entry : entries) {
      all.low = glm::min(all.low, entry.low);
      all.high = glm::max(all.high, entry.high);
      all.deepest = std::min(all.deepest, entry.deepest);
    }
    for (CasterLoops& entry : entries)
      entry.low = all.low, entry.high = all.high, entry.deepest = all.deepest;
  }
}
}  // namespace

const CasterCluster::Stage* CasterCluster::stageFor(float receiversHighestI) const {
  const Stage* last = nullptr;
  for (const Stage& stage : stages) {
    if (stage.behindI >= receiversHighestI) last = &stage;
  }
  return last;
}

SubLightLoops loopsOf(const scene::LightSilhouettes& silhouettes,
                      std::span<const scene::PlacedCaster> casters, const SubLight& light,
                      const ListSpace& space, std::span<const RoomPart> seenInside) {
  SubLightLoops result{.light = light};
  std::vector<glm::vec3> loop;
  std::uint32_t layersLeft = 0;
  for (const scene::LightSilhouettes::Caster& source : silhouettes.casters) {
    const bool isLayer = layersLeft > 0;
    layersLeft = isLayer ? layersLeft - 1 : source.layerCount;
    CasterLoops& caster = (isLayer ? result.layers : result.casters).emplace_back();
    caster.firstLayer = static_cast<std::uint32_t>(result.layers.size());
    caster.layerCount = source.layerCount;
    caster.layersBefore = source.layersBefore;
    caster.enclosesLight = source.enclosesLight;
    for (std::uint32_t l = source.firstLoop; l < source.firstLoop + source.loopCount; ++l) {
      loop.clear();
      for (std::uint32_t k = 0; k < silhouettes.loops[l].count; ++k) {
        loop.emplace_back(space.tangentPoint(silhouettes.points[silhouettes.loops[l].first + k]));
      }
      caster.addLoop(loop);
    }
    boundPart(source.partWorld, space, caster);
    caster.deepest = static_cast<float>(1.0 / static_cast<double>(source.deepest) - space.originI);
    caster.object = source.object;
    caster.part = source.part;
    caster.turnedAway = source.turnedAway;
    caster.convex = casters[source.object].mesh->parts()[source.part].convex;
    if (std::ranges::find(seenInside, RoomPart{source.object, source.part}) != seenInside.end()) {
      caster.isRoom = source.enclosesLight;
      caster.seenInside = !source.enclosesLight;
      caster.convex = caster.convex && !caster.isRoom;
      caster.enclosesLight = false;
    }
  }
  boundTogether(result.casters);
  result.clusters = casterClusters(silhouettes, result, space);
  return result;
}

}  // namespace halfshadow::outlines
