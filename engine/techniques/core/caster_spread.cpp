// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/caster_spread.hpp"

#include <cmath>

namespace halfshadow::techniques {

std::optional<StandIn> sampledWhereCastersSpread(const LightScene& scene, double widestRatio) {
  const double ratio = scene.fit().farDistance / scene.fit().nearDistance;
  if (scene.fit().empty || ratio <= widestRatio) return std::nullopt;
  return StandIn{"sampled",
                 "wide-depth-range: the farthest caster is " + std::to_string(std::lround(ratio)) +
                     " times or more as far from the light as the nearest, which one map from the light's "
                     "centre does not resolve"};
}

}  // namespace halfshadow::techniques
