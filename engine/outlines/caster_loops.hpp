// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Silhouette loops as seen from a set of receivers: which of their vertices matter there.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "outlines/near_loops.hpp"
#include "outlines/outer_sides.hpp"
#include "outlines/tangent_space.hpp"
#include "scene/light_silhouettes.hpp"

namespace halfshadow::outlines {

/// A closed part of a caster.
struct RoomPart {
  std::uint32_t object = 0;  ///< PlacedCaster::object
  std::uint32_t part = 0;
  bool operator==(const RoomPart&) const = default;
};

/// Loops of one caster part seen from one sub-light, in (t, i); counter-clockwise around what they cover.
struct CasterLoops {
  struct Loop {
    std::uint32_t first = 0, count = 0;  ///< in `points`
    bool oneSided = false;               ///< counts only where what it covers is positive
  };
  std::vector<glm::vec3> points;
  std::vector<Loop> loops;
  glm::vec3 low{1e30f}, high{-1e30f};
  /// Bounds of its whole part, not only of its loops: where they lie beyond one side of the light for some
  /// receivers, it covers nothing for them, and none of them is inside it.
  glm::vec3 partLow{-1e30f}, partHigh{1e30f};
  float deepest = 0.0f;        ///< as scene::LightSilhouettes::Caster::deepest, the smallest i
  bool enclosesLight = false;  ///< and no receiver that is seen stands inside it
  bool isRoom = false;         ///< it encloses the light, and receivers stand inside it: only faces tell
  bool seenInside = false;     ///< it does not, but receivers may stand inside it all the same
  /// In SubLightLoops::layers: this caster's single layers, which take its place for receivers behind all of
  /// it; none where it does not hide itself.
  std::uint32_t firstLayer = 0, layerCount = 0;
  bool layersBefore = false;  ///< another entry of its part, before this one, has the layers of both
  std::uint32_t object = 0, part = 0;
  bool turnedAway = false;  ///< the side of a sheet that looks away from the light
  /// Its loops tell what it covers for receivers that are not behind all of it, too, unless they are its own.
  bool convex = true;

  void clear();
  void addLoop(std::span<const glm::vec3> loop);
};

/// Casters that touch each other, and hide some of each other from a sub-light's centre: a head under its
/// hair, the boards of a fence. Their edges lie over each other on the light, so that shares of it do not
/// multiply; what they cover together does.
struct CasterCluster {
  /// For receivers behind the first so many of the members.
  struct Stage {
    std::uint32_t members = 0;
    float behindI = 0.0f;  ///< no point of these has a smaller i
    CasterLoops together;
  };
  std::vector<std::uint32_t> members;  ///< in SubLightLoops::casters; those come first that end first
  std::vector<Stage> stages;           ///< with more and more members
  /// The last one whose members all of the receivers are behind, or null.
  const Stage* stageFor(float receiversHighestI) const;
};

/// All casters of one sub-light.
struct SubLightLoops {
  SubLight light;
  std::vector<CasterLoops> casters;
  std::vector<CasterLoops> layers;
  std::vector<CasterCluster> clusters;
};
/// `silhouettes` with layers alongside (scene::LayerSplit), of `casters` in their order.
/// `seenInside`: parts inside which receivers may be seen.
SubLightLoops loopsOf(const scene::LightSilhouettes& silhouettes,
                      std::span<const scene::PlacedCaster> casters, const SubLight& light,
                      const ListSpace& space, std::span<const RoomPart> seenInside = {});

enum class Coverage { none, full, partial };

/// Working memory of simplify().
struct SimplifyScratch {
  /// A vertex of a loop under simplification. `sure`: it lies before every receiver.
  struct Judged {
    glm::vec3 ti{0.0f};
    unsigned code = 0;
    bool sure = true;
  };
  std::vector<glm::vec3> cut, kept;
  std::vector<Judged> judged, collapsed;
  std::vector<std::uint32_t> mattering;
  NearLoops loops;
  NearLoopScratch near;
};

/// Writes into `result` loops that cover every cell of the sub-light exactly as `caster` does, for every
/// receiver in the box: parts farther from the light than all receivers are cut off, runs of vertices
/// beyond one side collapse to their chord, loops that cover nothing are dropped. `full`: the sub-light is
/// wholly covered for all of them; `none`: not at all (result empty).
Coverage simplify(const CasterLoops& caster, const SubLight& light, const TangentBox& receivers,
                  SimplifyScratch& scratch, CasterLoops& result);
/// `sides`: of the light and the receivers, for all of their casters.
Coverage simplify(const CasterLoops& caster, const SubLight& light, const TangentBox& receivers,
                  const OuterSides& sides, SimplifyScratch& scratch, CasterLoops& result);

/// The same from the faces of a caster, for receivers not behind all of it. `facets`: those that matter, or
/// more; `lights`: of the light's part and each facet.
Coverage simplify(const NearSurface& surface, std::span<const std::uint32_t> facets, SheetSide side,
                  const SubLight& light, std::span<const FacetLight> lights, const ReceiverSet& receivers,
                  const OuterSides& sides, FacetChoice choice, SimplifyScratch& scratch, CasterLoops& result);

}  // namespace halfshadow::outlines
