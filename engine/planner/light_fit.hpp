// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The light-space view that depth maps are rendered with: from the light's centre, along its emission
/// direction, sides parallel to the light's, fitted to the casters. Pure data, double precision.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "base/block_fold.hpp"
#include "base/list_changes.hpp"
#include "planner/light_space.hpp"
#include "scene/bounds.hpp"
#include "scene/light.hpp"
#include "scene/mesh.hpp"

namespace halfshadow::planner {

/// Light space: origin at the light's centre, x along halfU, y along halfV, z along the emission direction
/// (right-handed: z = x × y), world units. A point's tangent coordinates are (x/z, y/z).
/// The map covers tangents [tangentLow, tangentHigh]; its content is affine in reciprocal depth:
/// storedDepth = (1/near - 1/z) / (1/near - 1/far), 0 at near, 1 at far.
struct LightFit {
  glm::dmat4 lightFromWorld{1.0};
  glm::dvec2 halfSize{0.0};  ///< world half lengths of the light along x and y
  glm::dvec2 tangentLow{-1.0}, tangentHigh{1.0};
  double nearDistance = 1.0, farDistance = 2.0;  ///< along z
  /// Beyond all casters, but not far; moves in steps. Of a split light, where the places in all its maps
  /// agree.
  double alignedDistance = 2.0;
  /// Along z, of what the map holds, between the two: those move in steps, which from a sun are many times as
  /// long as the scene.
  double nearestCaster = 1.0, farthestCaster = 2.0;
  bool castersCrossPlane = false;  ///< they reach the light's plane
  bool castersBeforeNear = false;  ///< parts of casters lie between the light's plane and nearDistance
  /// A caster comes nearer to the light than LightFitOptions::nearShare of its longer side: points of the
  /// light see it from such different directions that a view from the centre cannot stand for them.
  bool casterNearLight = false;
  int mapSize = 1024;
  int growth = 1;     ///< times as many texels a side as asked, see LightFitOptions::mostMapSize
  bool empty = true;  ///< no caster in front of the light

  /// Texels per unit tangent, along x and y.
  glm::dvec2 texelsPerTangent() const { return glm::dvec2(mapSize) / (tangentHigh - tangentLow); }
  /// Clip space of the map: w = z, x and y in [-w, w], depth -1 … 1 from near to far, affine in 1/z after
  /// the divide.
  glm::dmat4 clipFromLight() const;
  double storedDepth(double z) const;
};

struct LightFitOptions {
  int mapSize = 1024;
  int borderTexels = 2;     ///< kept free of casters, so that clamped taps outside read "lit"
  double maxTangent = 8.0;  ///< casters farther off-axis are cut: 83 degrees
  /// The map is doubled, up to so many texels a side, while its window is wider than wideWindow for mapSize
  /// of them: casters past 60 degrees off-axis would leave few for what is before the light.
  int mostMapSize = 0;
  double wideWindow = 5.2;     ///< tangents: 1.5 times those of a cone of 60 degrees to each side
  double minNearShare = 1e-3;  ///< near is at least this share of the casters' largest distance
  double nearShare = 1.0;
  /// Half extent of the centres of sub-lights whose maps share the window, see SubLights; the window then
  /// holds the casters as each of them sees them, shifted so that they agree at alignedDistance.
  glm::dvec2 centerSpread{0.0};
};

/// A caster as fits see it.
struct CasterShape {
  std::uint64_t id = 0, revision = 0;  ///< `revision` changes with its mesh or place
  /// Their convex hull holds it: see scene::enclosingPoints().
  std::span<const glm::dvec3> pointsWorld;
  scene::Bounds boundsWorld;  ///< of the points; fits do not read it
  /// Both, or none: then it is never casterNearLight.
  const scene::TriangleMesh* mesh = nullptr;
  const glm::dmat4* worldFromObject = nullptr;
};

/// Fits one light, frame after frame. Of a caster and a light that are where they were it looks at nothing
/// again.
class LightFitter {
 public:
  /// Smallest view of the casters' points that fulfils the options; extents grow in steps of 1/16 octave and
  /// the origin is snapped to whole texels, so that a moving caster does not make static shadow edges crawl.
  /// `changes`: of the casters, by place.
  LightFit fit(const scene::AreaLight& light, std::span<const CasterShape> casters,
               const LightFitOptions& options, const ListChanges& changes = {});
  /// Casters whose points were looked at, since it was made.
  std::uint64_t castersMeasured() const { return castersMeasured_; }

 private:
  /// Of one caster in light space.
  struct Extent {
    std::uint64_t id = 0, revision = 0;
    double nearest = 0.0, farthest = 0.0;  ///< along z
    glm::dvec2 low{0.0}, high{0.0};
    glm::dvec2 tangentLow{0.0}, tangentHigh{0.0};  ///< where all of it lies before the light
    bool nearLight = false;
  };
  /// Of all casters.
  struct Total {
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    glm::dvec2 tangentLow{std::numeric_limits<double>::infinity()};
    glm::dvec2 tangentHigh{-std::numeric_limits<double>::infinity()};
    bool nearLight = false;
    template <typename Part>
    void include(const Part& part);
  };
  Extent extentOf(const CasterShape& caster) const;
  void measure(std::span<const CasterShape> casters, const ListChanges& changes);
  void fitCutTangents(std::span<const CasterShape> casters, double nearDistance, glm::dvec2& low,
                      glm::dvec2& high) const;

  LightSpace space_;
  double nearLightDistance_ = 0.0;
  glm::dvec2 centerSpread_{0.0};
  std::vector<Extent> extents_;  ///< of the casters in their order
  std::vector<Extent> before_;   ///< of the frame before, while they are sorted in
  BlockFold<Total> totals_;      ///< of `extents_`
  std::uint64_t seen_ = 0;       ///< revision of the casters that `extents_` are of
  std::uint64_t castersMeasured_ = 0;
};

/// The same once.
LightFit fitLight(const scene::AreaLight& light, std::span<const CasterShape> casters,
                  const LightFitOptions& options);
LightFit fitLight(const scene::AreaLight& light, std::span<const glm::dvec3> pointsWorld,
                  const LightFitOptions& options);

}  // namespace halfshadow::planner
