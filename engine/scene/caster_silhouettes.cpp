// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/caster_silhouettes.hpp"

#include <algorithm>
#include <unordered_set>

namespace halfshadow::scene {

void CasterSilhouettes::extract(const PlacedCaster& caster, const LightPoint& point, Silhouette& silhouette) {
  extractSilhouette(*caster.mesh, caster.objectFromWorld(point.world), scratch_, silhouette);
  ++extracted_;
}

const Silhouette& CasterSilhouettes::of(const PlacedCaster& caster, const LightPoint& point) {
  if (caster.revision == 0) {
    extract(caster, point, unknown_);
    return unknown_;
  }
  std::list<Entry>& kept = byRevision_[caster.revision];
  auto entry = std::ranges::find_if(kept, [&](const Entry& e) { return e.point.place == point.place; });
  const bool isNew = entry == kept.end();
  if (isNew) entry = kept.emplace(kept.end());
  if (isNew || entry->point.world != point.world) {
    entry->point = point;
    extract(caster, point, entry->silhouette);
  }
  return entry->silhouette;
}

void CasterSilhouettes::keepOnly(std::span<const PlacedCaster> casters) {
  if (byRevision_.empty()) return;
  std::unordered_set<std::uint64_t> revisions;
  for (const PlacedCaster& caster : casters) revisions.insert(caster.revision);
  std::erase_if(byRevision_, [&](const auto& kept) { return !revisions.contains(kept.first); });
}

}  // namespace halfshadow::scene
