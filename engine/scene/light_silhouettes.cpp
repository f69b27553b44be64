// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/light_silhouettes.hpp"

#include <algorithm>

namespace halfshadow::scene {
namespace {
glm::dvec3 atLeast(const glm::dvec3& halfVector, const glm::dvec3& fallback, double length) {
  const double own = glm::length(halfVector);
  return own >= length ? halfVector : (own > 0.0 ? halfVector * (length / own) : fallback * length);
}

/// Cuts a closed loop at h = minHeight.
/// Based on: Sutherland, Hodgman, "Reentrant Polygon Clipping", 1974.
void clipLoop(const std::vector<glm::dvec3>& loop, double minHeight, std::vector<glm::vec3>& out) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec3& a = loop[i];
    const glm::dvec3& b = loop[i + 1 == loop.size() ? 0 : i + 1];
    const bool aIn = a.z >= minHeight, bIn = b.z >= minHeight;
    if (aIn) out.emplace_back(a);
    if (aIn != bIn) out.emplace_back(glm::mix(a, b, (minHeight - a.z) / (b.z - a.z)));
  }
}
}  // namespace

LightPlane::LightPlane(const AreaLight& light, double heightUnitWorld, double minHalfLength)
    : centerWorld(light.centerWorld), normal(emissionDirection(light)), heightUnit(heightUnitWorld) {
  const glm::dvec3 helper = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 across = glm::normalize(glm::cross(helper, normal));
  halfU = atLeast(light.halfU, across, minHalfLength);
  const glm::dvec3 besideU = glm::normalize(glm::cross(normal, halfU));
  halfV = atLeast(light.halfV, besideU, minHalfLength);
  axes = glm::inverse(glm::dmat3(halfU, halfV, normal * heightUnitWorld));
}

glm::dvec3 LightPlane::toWorld(const glm::dvec3& abh) const {
  return centerWorld + abh.x * halfU + abh.y * halfV + abh.z * heightUnit * normal;
}

void lightSilhouettes(std::span<const PlacedCaster> casters, const LightPlane& plane, double sourceA,
                      double sourceB, double minHeight, LightSilhouettes& result) {
  result.points.clear();
  result.loops.clear();
  result.casters.clear();
  const glm::dvec3 sourceWorld = plane.toWorld({sourceA, sourceB, 0.0});
  thread_local Silhouette silhouette;
  std::vector<glm::dvec3> loopPoints;
  for (const PlacedCaster& caster : casters) {
    const glm::dmat3 linear(caster.worldFromObject);
    const glm::dvec3 originWorld(caster.worldFromObject[3]);
    extractSilhouette(*caster.mesh, glm::inverse(linear) * (sourceWorld - originWorld), silhouette);
    // (a, b, h) = lightFromObject · object + offset; the large translations cancel in double.
    const glm::dmat3 lightFromObject = plane.axes * linear;
    const glm::dvec3 offset = plane.fromWorld(originWorld);
    // Seen from the light counter-clockwise is clockwise in (a, b); a mirrored object turns round once more.
    const bool reverse = glm::determinant(linear) > 0.0;
    for (const Silhouette::Part& part : silhouette.parts) {
      LightSilhouettes::Caster placed{.object = caster.object,
                                      .part = part.part,
                                      .firstLoop = static_cast<std::uint32_t>(result.loops.size()),
                                      .low = glm::vec3(1e30f),
                                      .high = glm::vec3(-1e30f),
                                      .closed = caster.mesh->parts()[part.part].closed,
                                      .enclosesLight = part.enclosesLight};
      for (std::uint32_t l = part.firstLoop; l < part.firstLoop + part.loopCount; ++l) {
        const Silhouette::Loop& loop = silhouette.loops[l];
        loopPoints.clear();
        for (std::uint32_t i = 0; i < loop.count; ++i) {
          const std::uint32_t vertex = silhouette.vertices[loop.first + i];
          loopPoints.push_back(lightFromObject * glm::dvec3(caster.mesh->positions()[vertex]) + offset);
        }
        if (reverse) std::reverse(loopPoints.begin(), loopPoints.end());
        const auto first = static_cast<std::uint32_t>(result.points.size());
        clipLoop(loopPoints, minHeight, result.points);
        const auto count = static_cast<std::uint32_t>(result.points.size()) - first;
        if (count < 3) {
          result.points.resize(first);
          continue;
        }
        result.loops.push_back({first, count});
        for (std::uint32_t i = first; i < first + count; ++i) {
          placed.low = glm::min(placed.low, result.points[i]);
          placed.high = glm::max(placed.high, result.points[i]);
        }
      }
      placed.loopCount = static_cast<std::uint32_t>(result.loops.size()) - placed.firstLoop;
      if (placed.loopCount > 0 || placed.enclosesLight) result.casters.push_back(placed);
    }
  }
}

}  // namespace halfshadow::scene
