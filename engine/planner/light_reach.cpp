// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/light_reach.hpp"

#include <cmath>

namespace halfshadow::planner {

scene::AreaLight lightWithinReach(const scene::AreaLight& light, const scene::Bounds& castersWorld) {
  if (castersWorld.empty()) return light;
  const double radius = castersWorld.radius();
  if (!(radius > 0.0) || !std::isfinite(radius)) return light;
  // Whole octaves for both: the light's distance about a point of a grid as wide as the casters.
  const double step = std::exp2(std::ceil(std::log2(radius)));
  const glm::dvec3 middle = step * glm::round(castersWorld.center() / step);
  const double octaves =
      std::floor(std::log2(glm::length(light.centerWorld - middle) / (kLightReach * step)));
  if (!(octaves >= 1.0)) return light;
  const double share = std::exp2(-octaves);
  scene::AreaLight nearer = light;
  nearer.centerWorld = middle + share * (light.centerWorld - middle);
  nearer.halfU *= share;
  nearer.halfV *= share;
  return nearer;
}

}  // namespace halfshadow::planner
