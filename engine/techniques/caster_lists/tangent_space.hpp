// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The coordinates of receivers and silhouettes in lists. With (a, b, h) the light's coordinates
/// (scene::LightPlane), a point is (t, i) = (a/h, b/h, 1/h). Seen from a receiver P, a point E in front of it
/// projects onto the light at (tE - tP) / (iE - iP): two subtractions and a division, linear in E and in P
/// before the division, and planes stay planes. The light is the square [-1, 1]².
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "scene/light_silhouettes.hpp"

namespace halfshadow::techniques {

inline glm::dvec3 tangentPoint(const glm::dvec3& abh) {
  return {abh.x / abh.z, abh.y / abh.z, 1.0 / abh.z};
}

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

}  // namespace halfshadow::techniques
