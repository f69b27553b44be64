// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Silhouettes of placed casters in the coordinates of a rectangular light: input of every wedge technique.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/half_edge_mesh.hpp"
#include "scene/light.hpp"

namespace halfshadow::scene {

/// Coordinates (a, b, h) of a light: the point centerWorld + a·halfU + b·halfV + h·heightUnit·n, n the
/// emission. The light is the square [-1, 1]² at h = 0, its lit side h > 0; u × v = n, so loops that run
/// counter-clockwise for an observer at the light run clockwise in (a, b).
/// Half vectors shorter than `minHalfLength` are lengthened to it: point lights stay finite.
struct LightPlane {
  LightPlane() = default;
  /// `heightUnitWorld`: world length of h = 1, best the largest distance of a receiver from the light's
  /// plane.
  LightPlane(const AreaLight& light, double heightUnitWorld, double minHalfLength);
  glm::dvec3 fromWorld(const glm::dvec3& pointWorld) const { return axes * (pointWorld - centerWorld); }
  glm::dvec3 toWorld(const glm::dvec3& abh) const;

  glm::dvec3 centerWorld{0.0}, halfU{1, 0, 0}, halfV{0, 1, 0}, normal{0, 0, 1};
  double heightUnit = 1.0;
  glm::dmat3 axes{1.0};  ///< (a, b, h) = axes · (world - centerWorld)
};

/// A caster's mesh where it stands.
struct PlacedCaster {
  const HalfEdgeMesh* mesh = nullptr;
  glm::dmat4 worldFromObject{1.0};
  std::uint32_t object = 0;  ///< the caller's number
};

struct LightSilhouettes {
  struct Loop {
    std::uint32_t first = 0, count = 0;  ///< in `points`, closed
  };
  /// One connected part of one caster.
  struct Caster {
    std::uint32_t object = 0, part = 0;
    std::uint32_t firstLoop = 0, loopCount = 0;
    glm::vec3 low{0.0f}, high{0.0f};  ///< bounds of its loops in (a, b, h)
    bool closed = true;               ///< else a sheet: a loop may count two layers
    bool enclosesLight = false;       ///< the source lies inside it: nothing outside sees the light
  };
  /// (a, b, h), all with h >= `minHeight`; loops run counter-clockwise in (a, b) around what they cover.
  std::vector<glm::vec3> points;
  std::vector<Loop> loops;
  std::vector<Caster> casters;
};

/// Silhouettes seen from the point (sourceA, sourceB) of the light, cut at h = minHeight (> 0, small): what
/// reaches behind the light is closed along the cut. Replaces the content of `result`.
void lightSilhouettes(std::span<const PlacedCaster> casters, const LightPlane& plane, double sourceA,
                      double sourceB, double minHeight, LightSilhouettes& result);

}  // namespace halfshadow::scene
