// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/caster_volumes/caster_volumes.hpp"

#include <algorithm>
#include <tuple>

namespace halfshadow::techniques {
namespace {
/// A receiver is behind the whole caster when its i is smaller than that of the farthest vertex by this share
/// of the caster's size, or of what single precision knows.
constexpr float kBehind = 1e-3f, kRounding = 1e-5f;

float splitMargin(const glm::vec3& low, const glm::vec3& high) {
  const glm::vec3 size = high - low;
  return std::max(kBehind * std::max({size.x, size.y, size.z}), kRounding * std::abs(low.z));
}

outlines::WedgeExtent extentOf(const outlines::CasterLoops& caster, const outlines::SubLight& light,
                               const outlines::ListSpace& space, outlines::WedgeExtent extent = {}) {
  const glm::dvec2 center(light.center), half(light.half);
  extent.lightLow = center - half;
  extent.lightHigh = center + half;
  for (const glm::vec3& point : caster.points) extent.include(space.lightPoint(glm::dvec3(point)));
  return extent;
}

/// Whole loops, each vertex and the first once more; of two sides the larger counts.
std::uint32_t addLoops(std::span<const outlines::CasterLoops* const> sides, std::uint8_t subLight,
                       outlines::TileLists& lists) {
  outlines::TileList list{.first = static_cast<std::uint32_t>(lists.records.size()), .casters = 1};
  for (const outlines::CasterLoops* side : sides) {
    for (const outlines::CasterLoops::Loop& loop : side->loops) {
      for (std::uint32_t k = 0; k <= loop.count; ++k) {
        lists.records.push_back({.ti = side->points[loop.first + k % loop.count],
                                 .subLight = subLight,
                                 .startsLoop = k == 0,
                                 .closesLoop = k == loop.count});
      }
    }
    lists.records.back().end = outlines::ListRecord::End::caster;
    lists.records.back().firstSide = side != sides.back();
    lists.sides = lists.sides || lists.records.back().firstSide;
  }
  list.count = static_cast<std::uint32_t>(lists.records.size()) - list.first;
  lists.longestList = std::max(lists.longestList, list.count);
  lists.tiles.push_back(list);
  return static_cast<std::uint32_t>(lists.tiles.size() - 1);
}

class Collector {
 public:
  Collector(CasterVolumes& result, const outlines::ListSpace& space, const VolumeReach& reach)
      : result_(result), space_(space), reach_(reach) {}

  void add(const outlines::SubLightLoops& loops, std::uint32_t subLight) {
    untilI_.assign(loops.casters.size(), kNever);
    for (std::uint32_t k = 0; k < loops.clusters.size(); ++k)
      addCluster(loops, loops.clusters[k], subLight, static_cast<std::uint32_t>(loops.casters.size()) + k);
    for (std::uint32_t c = 0; c < loops.casters.size(); ++c) {
      const outlines::CasterLoops& caster = loops.casters[c];
      if (caster.loops.empty()) continue;
      const float margin = splitMargin(caster.low, caster.high), splitI = caster.low.z - margin;
      CasterVolume volume{.subLight = subLight,
                          .caster = c,
                          .extent = extentOf(caster, loops.light, space_),
                          .splitI = splitI};
      const bool secondSide = isSecondSide(loops, c), firstSide = isSecondSide(loops, c + 1);
      std::vector<const outlines::CasterLoops*> sides{&caster};
      if (firstSide) {
        sides.push_back(&loops.casters[c + 1]);
        volume.extent = extentOf(loops.casters[c + 1], loops.light, space_, volume.extent);
      }
      if (volume.extent.nearest >= reach_.end) continue;
      // A little of both sides of the split, so that rounding leaves no receiver outside.
      const double from = heightOf(splitI + 0.1f * margin), until = heightOf(splitI - 0.1f * margin);
      if (!secondSide) {
        volume.list = addLoops(sides, static_cast<std::uint8_t>(subLight), result_.lists);
        addPart(volume, WedgePart::beside, volume.extent.nearest, until);
      }
      volume.untilI = untilI_[c];
      const double end = heightOf(untilI_[c] - 0.1f * margin);
      if (caster.layerCount == 0 && !caster.layersBefore) addPart(volume, WedgePart::beyond, from, end);
      for (std::uint32_t l = 0; l < caster.layerCount; ++l)
        addBeyond(loops.layers[caster.firstLayer + l], loops.light, volume, from, end);
    }
  }

 private:
  static constexpr float kNever = -1e30f;

  /// One of exactly two sides.
  static bool isSecondSide(const outlines::SubLightLoops& loops, std::uint32_t c) {
    const auto goesOn = [&](std::uint32_t k) {
      return k < loops.casters.size() && loops.casters[k].layersBefore;
    };
    return goesOn(c) && !goesOn(c + 1) && c > 0 && !loops.casters[c - 1].layersBefore &&
           !loops.casters[c].loops.empty() && !loops.casters[c - 1].loops.empty();
  }

  void addCluster(const outlines::SubLightLoops& loops, const outlines::CasterCluster& cluster,
                  std::uint32_t subLight, std::uint32_t number) {
    float toI = kNever, margin = 0.0f;
    for (std::size_t s = cluster.stages.size(); s-- > 0;) {
      const outlines::CasterCluster::Stage& stage = cluster.stages[s];
      margin = splitMargin(glm::vec3(glm::vec2(stage.together.low), stage.behindI), stage.together.high);
      const float fromI = stage.behindI - margin;
      CasterVolume volume{
          .subLight = subLight, .caster = number, .splitI = stage.behindI, .fromI = fromI, .untilI = toI};
      addBeyond(stage.together, loops.light, volume, heightOf(fromI + 0.1f * margin),
                heightOf(toI - 0.1f * margin));
      for (std::uint32_t k = 0; k < stage.members; ++k) untilI_[cluster.members[k]] = fromI;
      toI = fromI;
    }
  }

  void addBeyond(const outlines::CasterLoops& loops, const outlines::SubLight& light, CasterVolume volume,
                 double from, double end) {
    if (loops.loops.empty()) return;
    volume.extent = extentOf(loops, light, space_);
    const outlines::CasterLoops* only = &loops;
    volume.list = addLoops({&only, 1}, static_cast<std::uint8_t>(volume.subLight), result_.lists);
    addPart(volume, WedgePart::beyond, from, end);
  }

  double heightOf(float i) const {
    return static_cast<double>(i) + space_.originI > 0.0 ? space_.height(i) : reach_.end;
  }
  void addPart(CasterVolume volume, WedgePart part, double from, double end) {
    volume.part = part;
    volume.from = from;
    volume.end = std::min(end, reach_.end);
    if (volume.from < volume.end) result_.volumes.push_back(volume);
  }
  CasterVolumes& result_;
  const outlines::ListSpace& space_;
  VolumeReach reach_;
  std::vector<float> untilI_;  ///< by caster: where its cluster takes over
};

bool shareReceivers(const CasterVolume& a, const CasterVolume& b) {
  // The two parts of one caster never answer for the same receiver.
  if (a.part != b.part && a.caster == b.caster) return false;
  if (a.untilI >= b.fromI || b.untilI >= a.fromI) return false;
  return a.extent.meetsBetween(b.extent, std::max(a.from, b.from), std::min(a.end, b.end));
}

/// Each volume goes into the first batch where it meets no other. Placing those first that meet most gave no
/// fewer batches.
std::uint32_t assignBatches(std::span<CasterVolume> volumes) {
  std::vector<std::vector<const CasterVolume*>> batches;
  for (CasterVolume& volume : volumes) {
    const auto fits = std::ranges::find_if(batches, [&](const std::vector<const CasterVolume*>& batch) {
      return std::ranges::none_of(batch,
                                  [&](const CasterVolume* other) { return shareReceivers(volume, *other); });
    });
    volume.batch = static_cast<std::uint32_t>(fits - batches.begin());
    if (fits == batches.end()) batches.emplace_back();
    batches[volume.batch].push_back(&volume);
  }
  return static_cast<std::uint32_t>(batches.size());
}
}  // namespace

CasterVolumes casterVolumes(std::span<const outlines::SubLightLoops> subLights,
                            const outlines::ListSpace& space, const VolumeReach& reach, Batching batching) {
  CasterVolumes result;
  Collector collector(result, space, reach);
  for (std::uint32_t s = 0; s < subLights.size(); ++s) {
    const std::size_t first = result.volumes.size();
    const bool enclosed = std::ranges::any_of(subLights[s].casters, &outlines::CasterLoops::enclosesLight);
    result.lightEnclosed.push_back(enclosed);
    if (enclosed) continue;
    collector.add(subLights[s], s);
    const std::span<CasterVolume> own = std::span(result.volumes).subspan(first);
    if (own.empty()) continue;
    const std::uint32_t batches = batching == Batching::disjoint ? assignBatches(own) : 1;
    result.batchCount = std::max(result.batchCount, batches);
    std::ranges::stable_sort(own, {}, [](const CasterVolume& v) { return std::tuple(v.batch, v.part); });
  }
  return result;
}

}  // namespace halfshadow::techniques
