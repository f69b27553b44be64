// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/light_scene.hpp"

#include <algorithm>

#include "base/keys.hpp"

namespace halfshadow::techniques {

glm::dmat4 heightFromWorld(const LightScene& scene) {
  glm::dmat4 rows;
  for (int column = 0; column < 4; ++column)
    rows[column] = glm::dvec4(scene.fit().lightFromWorld[column].z / scene.fit().nearDistance);
  return rows;
}

AtlasViews atlasViews(const LightScene& scene) {
  if (scene.subLights == nullptr) {
    const int size = scene.fit().mapSize;
    AtlasViews atlas{.views = {scene.center}, .atlasSize = size};
    atlas.views.front().rect = {0, 0, size, size};
    return atlas;
  }
  const planner::SubLights& split = *scene.subLights;
  const int tiles = split.grid.tilesPerSide(), side = split.shared.mapSize;
  const std::uint64_t gridKey = static_cast<std::uint64_t>(split.grid.alongU * 16 + split.grid.alongV);
  AtlasViews atlas{.atlasSize = tiles * side};
  for (const planner::LightFit& fit : split.fits) {
    const int index = static_cast<int>(atlas.views.size());
    LightView& view = atlas.views.emplace_back(scene.center);
    view.fit = fit;
    view.rect = {index % tiles * side, index / tiles * side, side, side};
    view.contentKey = combineKeys(scene.center.contentKey, gridKey);
    view.sceneKey = combineKeys(scene.center.sceneKey, gridKey);
  }
  return atlas;
}

std::span<const scene::PlacedCaster> placedCasters(const LightScene& scene) {
  if (scene.groups.holds(scene.contentKey)) return scene.groups.placed();
  std::vector<scene::SceneCaster> casters;
  for (const DrawItem& item : scene.casters) {
    casters.push_back({.mesh = item.sourceMesh,
                       .geometry = item.geometry,
                       .worldFromObject = item.worldFromObject,
                       .revision = item.revision});
  }
  scene.groups.update(casters, scene.contentKey);
  scene.silhouettes.keepOnly(scene.groups.placed());
  return scene.groups.placed();
}

std::uint32_t placedCasterOf(const LightScene& scene, const DrawItem& receiver) {
  const auto found = std::ranges::find(scene.casters, receiver.object, &DrawItem::object);
  if (found == scene.casters.end()) return kNoCaster;
  placedCasters(scene);
  return scene.groups.placedOf(static_cast<std::size_t>(found - scene.casters.begin()));
}

}  // namespace halfshadow::techniques
