// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/silhouette_layers.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::scene {
namespace {
/// Jagged outlines of fine meshes cover slivers twice: they cost vertices and darken nothing that is seen.
constexpr double kLeastShare = 0.01;
/// Of the first level: what rounding leaves.
constexpr double kLeastOfFirst = 1e-9;

class LayerSplitter {
 public:
  LayerSplitter(const LightSilhouettes& source, const glm::dvec2& sourcePoint)
      : source_(source), sourcePoint_(sourcePoint) {}

  /// Appends the layers of one part's entries to `out`.
  void split(std::span<const LightSilhouettes::Caster> entries, LayerSplit split, LightSilhouettes& out) {
    std::vector<CoveredLevels::Level> levels;
    const bool encloses = std::ranges::any_of(entries, &LightSilhouettes::Caster::enclosesLight);
    if (encloses || !findLevels(entries, levels) || (entries.size() == 1 && levels.size() <= 1)) {
      for (const LightSilhouettes::Caster& entry : entries) out.addCaster(source_, entry);
      return;
    }
    if (split == LayerSplit::outline) levels.resize(std::min<std::size_t>(levels.size(), 1));
    dropSmallLoops(levels);
    std::vector<const LightSilhouettes::Caster*> together;
    for (const LightSilhouettes::Caster& entry : entries) together.push_back(&entry);
    if (split != LayerSplit::alongside) {
      for (const CoveredLevels::Level& level : levels) addTogether(together, level, out);
      return;
    }
    const std::size_t first = out.casters.size();
    out.addCaster(source_, entries[0]);
    out.casters[first].layerCount = static_cast<std::uint32_t>(levels.size());
    for (const CoveredLevels::Level& level : levels) addTogether(together, level, out);
    for (const LightSilhouettes::Caster& entry : entries.subspan(1)) {
      out.addCaster(source_, entry);
      out.casters.back().layersBefore = true;
    }
  }

 private:
  bool findLevels(std::span<const LightSilhouettes::Caster> entries,
                  std::vector<CoveredLevels::Level>& levels) {
    arrangement_.start(sourcePoint_);
    for (const LightSilhouettes::Caster& entry : entries) {
      const auto side = entry.turnedAway ? CoveredLevels::Side::away : CoveredLevels::Side::towards;
      source_.forEachLoop(entry, [&](std::span<const glm::dvec3> loop) {
        arrangement_.addLoop(loop, entry.part - entries[0].part, side);
      });
    }
    return arrangement_.find(levels);
  }

  static void dropSmallLoops(std::vector<CoveredLevels::Level>& levels) {
    double area = 0.0;
    if (!levels.empty()) {
      for (const CoveredLevels::Loop& loop : levels[0]) area += loop.area;
    }
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double least = (i == 0 ? kLeastOfFirst : kLeastShare) * area;
      std::erase_if(levels[i], [&](const CoveredLevels::Loop& loop) { return std::abs(loop.area) < least; });
    }
    while (levels.size() > 1 && levels.back().empty()) levels.pop_back();
  }

  const LightSilhouettes& source_;
  glm::dvec2 sourcePoint_;
  CoveredLevels arrangement_;
};
}  // namespace

void splitLayers(LightSilhouettes& silhouettes, double sourceA, double sourceB, LayerSplit split) {
  if (split == LayerSplit::none) return;
  LightSilhouettes result;
  LayerSplitter splitter(silhouettes, {sourceA, sourceB});
  const std::span<const LightSilhouettes::Caster> casters(silhouettes.casters);
  for (std::size_t first = 0, end = 0; first < casters.size(); first = end) {
    // A sheet has an entry for each of its sides, and for each region of one.
    const auto joins = [&](const LightSilhouettes::Caster& other) {
      return other.object == casters[first].object && other.part == casters[first].part;
    };
    for (end = first + 1; end < casters.size() && joins(casters[end]);) ++end;
    splitter.split(casters.subspan(first, end - first), split, result);
  }
  result.counters = silhouettes.counters;
  silhouettes = std::move(result);
}

void addTogether(std::span<const LightSilhouettes::Caster* const> entries, const CoveredLevels::Level& level,
                 LightSilhouettes& out) {
  LightSilhouettes::Caster all = *entries[0];
  for (const LightSilhouettes::Caster* entry : entries) {
    all.deepest = std::max(all.deepest, entry->deepest);
    all.closed = all.closed && entry->closed;
    all.partWorld.include(entry->partWorld);
  }
  all.turnedAway = false;
  all.firstLoop = static_cast<std::uint32_t>(out.loops.size());
  all.loopCount = static_cast<std::uint32_t>(level.size());
  all.low = glm::vec3(1e30f);
  all.high = glm::vec3(-1e30f);
  for (const CoveredLevels::Loop& loop : level) {
    out.addLoop(loop.points);
    all.include(loop.points);
  }
  out.casters.push_back(all);
}

}  // namespace halfshadow::scene
