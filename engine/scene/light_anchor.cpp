// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/light_anchor.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::scene {
namespace {
/// Coordinates slanted more than this (length over height) lose digits to the slant.
constexpr double kMostSlant = 16.0;
/// Of the distance: within so much the anchor may be moved to a place that small motions do not change.
constexpr double kSnap = 1.0 / 16.0;
/// Of a caster's radius: what stands for the distance where the light lies in its box.
constexpr double kInside = 1e-3;

bool behind(const Bounds& box, const AreaLight& light, const glm::dvec3& normal) {
  return std::ranges::all_of(box.corners(), [&](const glm::dvec3& corner) {
    return glm::dot(normal, corner - light.centerWorld) <= 0.0;
  });
}
}  // namespace

glm::dvec3 toAnchor(const AreaLight& light, std::span<const Bounds> castersWorld) {
  const glm::dvec3 normal = emissionDirection(light);
  double distance = std::numeric_limits<double>::infinity(), radius = 1.0;
  glm::dvec3 nearest(0.0);
  for (const Bounds& box : castersWorld) {
    if (box.empty() || behind(box, light, normal)) continue;
    const glm::dvec3 point = glm::clamp(light.centerWorld, box.low, box.high);
    const double here = glm::length(point - light.centerWorld);
    if (here >= distance) continue;
    distance = here, radius = box.radius(), nearest = point;
  }
  const double size = std::max(glm::length(light.halfU), glm::length(light.halfV));
  if (!std::isfinite(distance)) return normal * (size > 0.0 ? size : 1.0);
  // Powers of two, which moving casters seldom change.
  const auto power = [](double length) { return std::exp2(std::floor(std::log2(length))); };
  const double snap = power(std::max(std::min(radius, kSnap * distance), 1e-300));
  const glm::dvec3 to = glm::round(nearest / snap) * snap - light.centerWorld;
  if (distance > 0.0 && glm::dot(normal, to) * kMostSlant >= glm::length(to)) return to;
  const double length = std::max({distance, size, kInside * radius});
  return normal * power(length > 0.0 ? length : 1.0);
}

}  // namespace halfshadow::scene
