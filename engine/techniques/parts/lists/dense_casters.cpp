// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/dense_casters.hpp"

#include <string>

#include "techniques/parts/maps/one_view.hpp"

namespace halfshadow::techniques {

std::optional<StandIn> standInForDenseCasters(const LightScene& scene) {
  const auto most = static_cast<std::size_t>(scene.settings.integer("outline_triangles"));
  std::size_t triangles = 0;
  bool cut = false;
  for (const DrawItem& caster : scene.casters) {
    triangles += caster.sourceMesh->indices.size() / 3;
    cut = cut || caster.alphaMask != nullptr;
  }
  if (!cut && triangles <= most) return std::nullopt;
  // Only now, since halves of edges are made for it: one silhouette tells all of a convex part.
  triangles = 0;
  for (const scene::PlacedCaster& caster : placedCasters(scene)) {
    for (const scene::CasterPart& part : caster.mesh->parts()) {
      if (!part.convex) triangles += part.faceCount;
    }
  }
  if (triangles <= most) return std::nullopt;
  if (auto instead = standInForOneView(scene)) return instead;
  return StandIn{"pcss-mip", "dense-casters: parts that are not convex have " + std::to_string(triangles) +
                                 " triangles, whose outlines would take seconds; outline_triangles=" +
                                 std::to_string(most) + " is the most that is tried"};
}

}  // namespace halfshadow::techniques
