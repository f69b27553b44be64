// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Silhouettes of placed casters in the coordinates of a rectangular light: input of every wedge technique.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "scene/caster_silhouettes.hpp"
#include "scene/light.hpp"

namespace halfshadow::scene {

/// Coordinates (a, b, h) of a light: the point centerWorld + a·halfU + b·halfV + h·toUnitHeight. The light is
/// the square [-1, 1]² at h = 0, its lit side h > 0; u × v = n, the emission, so loops that run
/// counter-clockwise for an observer at the light run clockwise in (a, b).
/// Half vectors shorter than `minHalfLength` are lengthened to it: point lights stay finite.
struct LightPlane {
  LightPlane() = default;
  /// `heightUnitWorld`: world length of h = 1, best the largest distance of a receiver from the light's
  /// plane.
  LightPlane(const AreaLight& light, double heightUnitWorld, double minHalfLength);
  /// `toUnitHeightWorld`: from the light's centre to the point (0, 0, 1), on the lit side; see
  /// light_anchor.hpp.
  LightPlane(const AreaLight& light, const glm::dvec3& toUnitHeightWorld, double minHalfLength);
  glm::dvec3 fromWorld(const glm::dvec3& pointWorld) const { return axes * (pointWorld - centerWorld); }
  glm::dvec3 toWorld(const glm::dvec3& abh) const;

  /// The place of (0, 0, 1).
  glm::dvec3 unitHeightWorld() const { return centerWorld + toUnitHeight; }

  glm::dvec3 centerWorld{0.0}, halfU{1, 0, 0}, halfV{0, 1, 0}, normal{0, 0, 1}, toUnitHeight{0, 0, 1};
  double heightUnit = 1.0;  ///< world distance of h = 1 from the light's plane
  glm::dmat3 axes{1.0};     ///< (a, b, h) = axes · (world - centerWorld)
};

struct LightSilhouettes {
  struct Loop {
    std::uint32_t first = 0, count = 0;  ///< in `points`, closed
  };
  /// One connected part of one caster, one side of an open one, or one layer of these (see LayerSplit).
  struct Caster {
    std::uint32_t object = 0, part = 0;
    std::uint32_t firstLoop = 0, loopCount = 0;
    /// With LayerSplit::alongside: so many of the next entries are this one's layers, for receivers behind
    /// it.
    std::uint32_t layerCount = 0;
    /// With LayerSplit::alongside: another entry of its part, before this one, has the layers of both.
    bool layersBefore = false;
    glm::vec3 low{0.0f}, high{0.0f};  ///< bounds of its loops in (a, b, h)
    Bounds partWorld;                 ///< of its part's surface
    /// No point of its part is farther from the light: the inside of a bowl is, than the loops, and the foot
    /// of a wall. Receivers behind this are behind all of it. Of convex parts that of their loops, which tell
    /// what they cover wherever they are cut.
    float deepest = 0.0f;
    /// Else one side of a sheet: the faces that look towards the light and those that look away are two
    /// entries, so that one entry covers nothing twice unless the surface itself folds.
    bool closed = true;
    bool turnedAway = false;  ///< the faces of a sheet that look away
    /// The source lies inside it: nothing outside sees the light, and for receivers inside it is the solid
    /// around a room. Its loops tell nothing.
    bool enclosesLight = false;

    /// Widens `low` and `high`.
    void include(std::span<const glm::dvec3> loop);
  };
  /// (a, b, h), all with h >= `minHeight`; loops run counter-clockwise in (a, b) around what they cover. In
  /// double: far from the light all heights are about equal.
  std::vector<glm::dvec3> points;
  std::vector<Loop> loops;
  std::vector<Caster> casters;
  Silhouette::Counters counters;  ///< of lightSilhouettes(), over all casters

  void clear();
  void append(const LightSilhouettes& other);  ///< all but the counters
  /// Calls `use` with the points of each loop of an entry of this one.
  template <typename Use>
  void forEachLoop(const Caster& entry, const Use& use) const {
    for (const Loop& loop : std::span(loops).subspan(entry.firstLoop, entry.loopCount))
      use(std::span(points).subspan(loop.first, loop.count));
  }
  void addLoop(std::span<const glm::dvec3> loop);
  /// Appends an entry of `other`, which is not this one, with its loops.
  void addCaster(const LightSilhouettes& other, Caster entry);
};

/// How often one entry may cover the same ground, seen from the source point. A caster that hides parts of
/// itself, like a person's arm before the body, has loops that lie within each other or cross. Layers step
/// from one such loop to the other along the ray from the source: they are meant for receivers behind the
/// whole caster (h above its `high.z`); receivers on the caster itself need the loops as they are.
enum class LayerSplit {
  none,       ///< one entry a part; its loops count each layer
  layers,     ///< one entry a layer: what is covered at all, at least twice, … as far as that is large
  outline,    ///< the first layer only: what is covered at all
  alongside,  ///< the entry as it is, followed by its layers where it has more than one
};

/// Silhouettes seen from the point (sourceA, sourceB) of the light, cut at h = minHeight (> 0, small): what
/// reaches through the light's plane is closed along the cut through its faces. Replaces the content of
/// `result`.
void lightSilhouettes(std::span<const PlacedCaster> casters, const LightPlane& plane, double sourceA,
                      double sourceB, double minHeight, LightSilhouettes& result,
                      LayerSplit split = LayerSplit::none);

/// Working memory of LightSilhouetteCache.
struct LoopScratch {
  std::vector<glm::dvec3> loop;
  std::vector<std::vector<glm::dvec3>> cutLoops;
};

/// Silhouettes seen from one point of one light in the coordinates of a plane, placed again only for casters
/// that changed.
class LightSilhouetteCache {
 public:
  /// Same result as lightSilhouettes(), from silhouettes that `extracted` has or finds. A caster is known by
  /// its `object` (and its place among casters that share one). A light that moved, another source point or
  /// split places everything anew. The reference lasts until the next call.
  const LightSilhouettes& update(CasterSilhouettes& extracted, std::span<const PlacedCaster> casters,
                                 const LightPlane& plane, double sourceA, double sourceB, double minHeight,
                                 LayerSplit split = LayerSplit::none);

  struct Counters {
    std::uint32_t placed = 0, reused = 0;  ///< casters
  };
  Counters counters() const { return counters_; }  ///< of the last update()
  /// Casters that the last update() placed, by their `object`.
  std::span<const std::uint32_t> changedObjects() const { return changedObjects_; }
  /// Counts up whenever the result differs from the one before: what was made from it is stale.
  std::uint64_t generation() const { return generation_; }

 private:
  struct View {
    glm::dvec3 centerWorld{0.0};
    glm::dmat3 axes{0.0};
    double sourceA = 0.0, sourceB = 0.0, minHeight = 0.0;
    LayerSplit split = LayerSplit::none;
    bool operator==(const View& other) const;
  };
  struct Entry {
    const HalfEdgeMesh* mesh = nullptr;
    std::uint64_t revision = 0, frame = 0;
    LightSilhouettes silhouettes;
  };
  View view_;
  std::unordered_map<std::uint64_t, Entry> entries_;  ///< by object, and in the high half its repetition
  std::vector<std::uint64_t> order_;                  ///< keys of what is in `result_`
  std::vector<std::uint32_t> changedObjects_;
  LightSilhouettes result_;
  LoopScratch scratch_;
  Counters counters_;
  std::uint64_t frame_ = 0, generation_ = 0;
};

}  // namespace halfshadow::scene
