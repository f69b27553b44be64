// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/one_view.hpp"

namespace halfshadow::techniques {

std::optional<StandIn> standInForOneView(const LightScene& scene) {
  if (scene.fit().empty || !scene.fit().casterNearLight) return std::nullopt;
  return StandIn{"sampled",
                 "caster-near-light: a caster comes nearer to the light than the light is wide, so that one "
                 "view from its centre cannot tell what its other points see"};
}

}  // namespace halfshadow::techniques
