// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The coordinates of receivers and silhouettes in lists. With (a, b, h) the light's coordinates
/// (scene::LightPlane), a point is (t, i) = (a/h, b/h, 1/h). Seen from a receiver P, a point E in front of it
/// projects onto the light at (tE - tP) / (iE - iP): two subtractions and a division, linear in E and in P
/// before the division, and planes stay planes. The light is the square [-1, 1]².
/// Only differences matter, so that the origin of (t, i) is free: far from the light it lies among the
/// casters, or single precision would not tell a caster's height from a receiver's.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "scene/light_silhouettes.hpp"

namespace halfshadow::outlines {

/// A light's coordinates and where (t, i) are counted from.
struct ListSpace {
  ListSpace() = default;
  ListSpace(const scene::LightPlane& light) : plane(light) {}  // NOLINT: the origin at t = 0, i = 0
  scene::LightPlane plane;
  glm::dvec2 originT{0.0};
  double originI = 0.0;
  /// Of (a, b, h).
  glm::dvec3 tangentPoint(const glm::dvec3& abh) const {
    return {(abh.x - originT.x * abh.z) / abh.z, (abh.y - originT.y * abh.z) / abh.z,
            (1.0 - originI * abh.z) / abh.z};
  }
  /// (a, b, h) of (t, i).
  glm::dvec3 lightPoint(const glm::dvec3& ti) const {
    const double h = 1.0 / (ti.z + originI);
    return {(ti.x + originT.x) * h, (ti.y + originT.y) * h, h};
  }
  double height(double i) const { return 1.0 / (i + originI); }
  /// A plane as dot(plane, (t.x, t.y, 1, i)): its signed distance, times the reciprocal height of the point.
  /// `relative`: a point of it, relative to the light's centre.
  glm::dvec4 planeThrough(const glm::dvec3& normalWorld, const glm::dvec3& relative) const {
    const double x = glm::dot(normalWorld, plane.halfU), y = glm::dot(normalWorld, plane.halfV);
    const double w = -glm::dot(normalWorld, relative);
    return {
        x, y,
        plane.heightUnit * glm::dot(normalWorld, plane.normal) + x * originT.x + y * originT.y + w * originI,
        w};
  }
  /// Rows that make (t, i) of a point in the world: (t, i) = (x, y, z) / w.
  glm::dmat4 homogeneousFromWorld() const;
};

inline glm::dvec3 tangentPoint(const glm::dvec3& abh) {
  return {abh.x / abh.z, abh.y / abh.z, 1.0 / abh.z};
}

/// Single precision, and what a rasteriser makes of it, knows a fragment's (t, i) to this share. Fragments of
/// casters stand off their own facets by so much, and by a step of the list's vertices: less than either
/// could put them on the wrong side.
inline constexpr double kPlaceRounding = 1e-6;

/// The receivers of one tile: all points with tangents in [tLow, tHigh] and reciprocal heights in
/// [iLow, iHigh].
struct TangentBox {
  glm::vec2 tLow{0.0f}, tHigh{0.0f};
  float iLow = 1.0f, iHigh = 0.0f;
  bool empty() const { return iLow > iHigh; }
  glm::vec3 center() const { return {0.5f * (tLow + tHigh), 0.5f * (iLow + iHigh)}; }
};

/// A part of the light, a quarter or all, with silhouettes of its own, its centre at `center`.
struct SubLight {
  glm::vec2 center{0.0f};
  float half = 0.5f;
};
inline constexpr SubLight kWholeLight{glm::vec2(0.0f), 1.0f};
inline constexpr int kSubLights = 4;
/// The quarters, in the order of lists: bit 0 of the index is the sign of a, bit 1 that of b.
inline constexpr std::array<SubLight, kSubLights> subLights() {
  return {{{{-0.5f, -0.5f}}, {{0.5f, -0.5f}}, {{-0.5f, 0.5f}}, {{0.5f, 0.5f}}}};
}

}  // namespace halfshadow::outlines
