// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A rectangle light as several smaller ones, each with a map of its own: a map sees its casters from one
/// point, and the error that this makes falls faster than the light's side. Pure data, double precision.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "planner/light_fit.hpp"
#include "scene/light.hpp"

namespace halfshadow::planner {

/// How many sub-lights a light is split into along halfU and along halfV.
struct SubLightGrid {
  int alongU = 1, alongV = 1;
  int count() const { return alongU * alongV; }
  bool whole() const { return count() == 1; }
  bool hasMiddle() const { return count() % 2 == 1; }
  /// Their maps stand in rows of a square.
  int tilesPerSide() const;
  bool operator==(const SubLightGrid&) const = default;
};

inline constexpr int kMostSubLightsPerSide = 4;

/// `perSide` along the light's longer side, and along the other so many that they are about as wide as long.
SubLightGrid subLightGrid(const scene::AreaLight& light, int perSide);

/// Side in texels of a sub-light's map when all of the grid share `mapSize` texels a side: as many as there
/// are, or some less or more (1.3 times as many texels at most, and `mostTexels` a side of all together), so
/// that they can be halved several times; 0 when that leaves too few to be halved.
int subLightMapSize(const SubLightGrid& grid, int mapSize, int mostTexels = 1 << 20);

/// What a split light is seen through. All sub-lights lie in one plane and their maps cover one window whose
/// places agree at one distance; hence a point at z that the light's centre sees at tangents t lies, in the
/// map of a sub-light at c, at t + c (1 / shared.alignedDistance - 1 / z).
struct SubLights {
  SubLightGrid grid;
  /// Fragments look for the penumbra's width in the map of the sub-light in the middle alone, and filter all
  /// with it: several times cheaper, and a third as much off again. Else in each.
  bool oneSearch = false;
  /// The light as it is, seen from its centre: but in the window that all share, by a map of their size.
  LightFit shared;
  glm::dvec2 halfSize{0.0};  ///< of a sub-light's, as LightFit::halfSize of the light's
  /// Light space, from a sub-light's centre to that of the next along halfU and halfV.
  glm::dvec2 stepU{0.0}, stepV{0.0};
  std::vector<LightFit> fits;  ///< each from its own centre; along halfU first, then along halfV
};

/// `side`: texels of each map a side. `empty` fits when no caster lies before the light. `fitter`: of this
/// light's splits alone.
SubLights fitSubLights(const scene::AreaLight& light, std::span<const CasterShape> casters,
                       const SubLightGrid& grid, int side, LightFitter& fitter,
                       const ListChanges& changes = {});
/// The same once.
SubLights fitSubLights(const scene::AreaLight& light, std::span<const glm::dvec3> casterPointsWorld,
                       const SubLightGrid& grid, int side);

/// What a number of sub-lights is decided from.
struct SubLightNeeds {
  double widestPenumbraTexels = 0.0;  ///< in one map of mapSize texels
  int mapSize = 1024;                 ///< texels a side that all sub-lights' maps share
  int perSide = 3;                    ///< of a light that is split
  /// Texels, from which on a penumbra is better seen through the maps of sub-lights. By default through nine:
  /// a sub-light then leaves a ninth of them.
  double worthSplitting = 60.0;
};
struct SubLightChoice {
  int perSide = 1;
  std::string reason;  ///< for the frame's report, begins with a code
};
/// As many as make the penumbrae that are left over wide enough to be filtered.
SubLightChoice chooseSubLights(const SubLightNeeds& needs);

}  // namespace halfshadow::planner
