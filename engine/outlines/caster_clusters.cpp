// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/caster_clusters.hpp"

#include <algorithm>

#include "scene/covered_levels.hpp"
#include "scene/edge_uses.hpp"
#include "scene/silhouette_layers.hpp"

namespace halfshadow::outlines {
namespace {
/// Stages of a cluster, evenly spread over its members.
constexpr std::uint32_t kStages = 4;

using Entry = scene::LightSilhouettes::Caster;

struct Rectangle {
  glm::dvec2 low{1e300}, high{-1e300};
};

/// What a caster covers, seen from the source point.
Rectangle seenFrom(const scene::LightSilhouettes& silhouettes, const Entry& entry, const glm::dvec2& source) {
  Rectangle seen;
  silhouettes.forEachLoop(entry, [&](std::span<const glm::dvec3> loop) {
    for (const glm::dvec3& p : loop) {
      const glm::dvec2 flat = (glm::dvec2(p) - source) / p.z;
      seen.low = glm::min(seen.low, flat);
      seen.high = glm::max(seen.high, flat);
    }
  });
  return seen;
}

/// Their boxes meet in the world, or those of their outlines seen along the light: what stands in rows one
/// behind the other has edges over each other all along a shadow.
bool touch(const Entry& p, const Entry& q) {
  if (p.partWorld.meets(q.partWorld)) return true;
  const auto alongLight = [](const Entry& entry) {
    return scene::Bounds{glm::dvec3(entry.low),
                         {entry.high.x, entry.high.y, std::max(entry.high.z, entry.deepest)}};
  };
  return alongLight(p).meets(alongLight(q));
}

/// Merges casters that touch and cover some of the same, among those that do not stand alone.
void mergeTouching(const scene::LightSilhouettes& silhouettes, std::span<const Entry* const> entries,
                   const glm::dvec2& source, auto&& standsAlone, scene::DisjointSets& sets) {
  std::vector<Rectangle> rectangles(entries.size());
  std::vector<std::uint32_t> byLeft, active;
  for (std::uint32_t c = 0; c < entries.size(); ++c) {
    if (standsAlone(c)) continue;
    rectangles[c] = seenFrom(silhouettes, *entries[c], source);
    byLeft.push_back(c);
  }
  std::ranges::sort(byLeft, {}, [&](std::uint32_t c) { return rectangles[c].low.x; });
  for (const std::uint32_t c : byLeft) {
    const Rectangle& own = rectangles[c];
    std::erase_if(active, [&](std::uint32_t other) { return rectangles[other].high.x < own.low.x; });
    for (const std::uint32_t other : active) {
      const Rectangle& its = rectangles[other];
      if (own.low.y < its.high.y && its.low.y < own.high.y && touch(*entries[c], *entries[other]))
        sets.merge(c, other);
    }
    active.push_back(c);
  }
}

class ClusterFinder {
 public:
  ClusterFinder(const scene::LightSilhouettes& silhouettes, const SubLightLoops& loops,
                const ListSpace& space)
      : silhouettes_(silhouettes), loops_(loops), space_(space) {
    for (std::size_t c = 0; c < silhouettes.casters.size(); c += silhouettes.casters[c].layerCount + 1)
      entries_.push_back(&silhouettes.casters[c]);
  }

  std::vector<CasterCluster> find() {
    std::vector<CasterCluster> clusters;
    for (std::vector<std::uint32_t>& members : groups()) {
      if (members.size() < 2) continue;
      CasterCluster cluster{.members = std::move(members)};
      // Entries of one part end alike and stay together.
      std::ranges::stable_sort(cluster.members, std::ranges::greater{},
                               [&](std::uint32_t c) { return behindI(c); });
      addStages(cluster);
      if (!cluster.stages.empty()) clusters.push_back(std::move(cluster));
    }
    return clusters;
  }

 private:
  float behindI(std::uint32_t c) const {
    return std::min(loops_.casters[c].low.z, loops_.casters[c].deepest);
  }

  bool standsAlone(std::uint32_t c) const {
    const CasterLoops& caster = loops_.casters[c];
    return caster.isRoom || caster.seenInside || caster.enclosesLight || caster.loops.empty();
  }

  std::vector<std::vector<std::uint32_t>> groups() const {
    const auto count = static_cast<std::uint32_t>(entries_.size());
    scene::DisjointSets sets(count);
    mergeTouching(
        silhouettes_, entries_, glm::dvec2(loops_.light.center),
        [&](std::uint32_t c) { return standsAlone(c); }, sets);
    // The sides of one part are one caster.
    for (std::uint32_t c = 1; c < count; ++c) {
      if (loops_.casters[c].layersBefore) sets.merge(c - 1, c);
    }
    std::vector<std::uint32_t> numberOf;
    std::vector<std::vector<std::uint32_t>> groups(sets.number(numberOf));
    for (std::uint32_t c = 0; c < count; ++c) {
      if (!standsAlone(c)) groups[numberOf[c]].push_back(c);
    }
    return groups;
  }

  void addStages(CasterCluster& cluster) {
    const auto count = static_cast<std::uint32_t>(cluster.members.size());
    std::uint32_t last = 0;
    for (std::uint32_t stage = 1; stage <= kStages; ++stage) {
      std::uint32_t members = (count * stage + kStages - 1) / kStages;
      while (members < count && loops_.casters[cluster.members[members]].layersBefore) ++members;
      if (members == last || partsAmong(cluster, members) < 2) continue;
      CasterCluster::Stage made{.members = members, .behindI = behindI(cluster.members[members - 1])};
      if (cover(cluster, members, made.together)) cluster.stages.push_back(std::move(made));
      last = members;
    }
  }

  std::uint32_t partsAmong(const CasterCluster& cluster, std::uint32_t members) const {
    std::uint32_t parts = 0;
    for (std::uint32_t k = 0; k < members; ++k)
      parts += loops_.casters[cluster.members[k]].layersBefore ? 0u : 1u;
    return parts;
  }

  bool cover(const CasterCluster& cluster, std::uint32_t members, CasterLoops& together) {
    arrangement_.start(glm::dvec2(loops_.light.center));
    std::uint32_t surface = 0;
    for (std::uint32_t k = 0; k < members; ++k) {
      const std::uint32_t c = cluster.members[k];
      if (k > 0 && !loops_.casters[c].layersBefore) ++surface;
      const auto side =
          entries_[c]->turnedAway ? scene::CoveredLevels::Side::away : scene::CoveredLevels::Side::towards;
      silhouettes_.forEachLoop(
          *entries_[c], [&](std::span<const glm::dvec3> loop) { arrangement_.addLoop(loop, surface, side); });
    }
    if (!arrangement_.find(levels_, 1) || levels_.empty()) return false;
    together.clear();
    together.convex = false;
    std::vector<glm::vec3> loop;
    for (const scene::CoveredLevels::Loop& found : levels_[0]) {
      loop.clear();
      for (const glm::dvec3& p : found.points) loop.emplace_back(space_.tangentPoint(p));
      together.addLoop(loop);
    }
    return true;
  }

  const scene::LightSilhouettes& silhouettes_;
  const SubLightLoops& loops_;
  const ListSpace& space_;
  std::vector<const Entry*> entries_;
  scene::CoveredLevels arrangement_;
  std::vector<scene::CoveredLevels::Level> levels_;
};

/// Whether what the entries of a group cover together was found: levels[0].
bool coveredByAny(const scene::LightSilhouettes& outlines, std::span<const std::uint32_t> group,
                  scene::CoveredLevels& arrangement, std::vector<scene::CoveredLevels::Level>& levels) {
  if (group.size() < 2) return false;
  arrangement.start(glm::dvec2(0.0));
  for (std::uint32_t k = 0; k < group.size(); ++k) {
    outlines.forEachLoop(outlines.casters[group[k]], [&](std::span<const glm::dvec3> loop) {
      arrangement.addLoop(loop, k, scene::CoveredLevels::Side::towards);
    });
  }
  return arrangement.find(levels, 1) && !levels.empty();
}

}  // namespace

std::vector<CasterCluster> casterClusters(const scene::LightSilhouettes& silhouettes,
                                          const SubLightLoops& loops, const ListSpace& space) {
  return ClusterFinder(silhouettes, loops, space).find();
}

scene::LightSilhouettes takenTogether(scene::LightSilhouettes outlines) {
  std::vector<const Entry*> entries;
  for (const Entry& entry : outlines.casters) entries.push_back(&entry);
  scene::DisjointSets sets(entries.size());
  const auto standsAlone = [&](std::uint32_t c) {
    return entries[c]->enclosesLight || entries[c]->loopCount == 0;
  };
  mergeTouching(outlines, entries, glm::dvec2(0.0), standsAlone, sets);
  std::vector<std::uint32_t> numberOf;
  std::vector<std::vector<std::uint32_t>> groups(sets.number(numberOf));
  if (groups.size() == entries.size()) return outlines;
  for (std::uint32_t c = 0; c < entries.size(); ++c) groups[numberOf[c]].push_back(c);
  scene::LightSilhouettes result;
  scene::CoveredLevels arrangement;
  std::vector<scene::CoveredLevels::Level> levels;
  std::vector<const Entry*> together;
  for (const std::vector<std::uint32_t>& group : groups) {
    if (coveredByAny(outlines, group, arrangement, levels)) {
      together.clear();
      for (const std::uint32_t c : group) together.push_back(entries[c]);
      scene::addTogether(together, levels[0], result);
    } else {
      for (const std::uint32_t c : group) result.addCaster(outlines, *entries[c]);
    }
  }
  return result;
}

}  // namespace halfshadow::outlines
