// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/one_view.hpp"

namespace halfshadow::techniques {

std::optional<StandIn> standInForOneView(const LightScene& scene) {
  const planner::LightFit& fit = scene.fit();
  if (fit.empty) return std::nullopt;
  // What crosses the light's plane is before the near distance only far to the side.
  if (fit.castersBeforeNear && !fit.castersCrossPlane) {
    return StandIn{"sampled",
                   "caster-before-map: a caster is nearer than a thousandth of the farthest one's distance, "
                   "where one map tells what it hides but not how wide its penumbra is"};
  }
  if (!fit.casterNearLight) return std::nullopt;
  return StandIn{"sampled",
                 "caster-near-light: a caster comes nearer to the light than the light is wide, so that one "
                 "view from its centre cannot tell what its other points see"};
}

}  // namespace halfshadow::techniques
