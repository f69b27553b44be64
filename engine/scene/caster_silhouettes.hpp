// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The silhouettes of one light's casters: what lists, wedges and volumes are made from, each in its own
/// coordinates.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <list>
#include <span>
#include <unordered_map>

#include "scene/placed_caster.hpp"

namespace halfshadow::scene {

/// A point of a light that casters are seen from.
struct LightPoint {
  glm::dvec2 place{0.0};  ///< in half sides, from the light's centre: which of its points it is
  glm::dvec3 world{0.0};  ///< where that is now
};

/// Extracts each silhouette once for the caster's revision and the point's place, however many ask for it,
/// and keeps it between frames.
class CasterSilhouettes {
 public:
  /// Lasts until the caster is dropped, or asked for again after the light moved. One of revision 0 is
  /// extracted in every call and lasts until the next.
  const Silhouette& of(const PlacedCaster& caster, const LightPoint& point);
  /// Drops those of all other casters, by their revisions.
  void keepOnly(std::span<const PlacedCaster> casters);
  /// Counts up with each extraction: what a frame adds is its work.
  std::uint64_t extracted() const { return extracted_; }

 private:
  struct Entry {
    LightPoint point;
    Silhouette silhouette;
  };
  void extract(const PlacedCaster& caster, const LightPoint& point, Silhouette& silhouette);
  std::unordered_map<std::uint64_t, std::list<Entry>> byRevision_;
  Silhouette unknown_;
  SilhouetteScratch scratch_;
  std::uint64_t extracted_ = 0;
};

}  // namespace halfshadow::scene
