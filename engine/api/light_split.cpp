// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/light_split.hpp"

#include <algorithm>
#include <charconv>

namespace halfshadow::api {
namespace {
/// Of the widest penumbra that a receiver inside the fit can have: f L (1 / zb - 1 / zr).
double widestPenumbraTexels(const planner::LightFit& fit, double receiverFarDistance) {
  const glm::dvec2 texels = fit.texelsPerTangent() * (2.0 * fit.halfSize);
  const double farthest = std::max(receiverFarDistance, fit.farthestCaster);
  return std::max(texels.x, texels.y) * (1.0 / fit.nearestCaster - 1.0 / farthest);
}
}  // namespace

const planner::SubLights* LightSplit::update(const Inputs& inputs, const techniques::Technique& technique,
                                             const techniques::Settings& settings, std::string& reason) {
  using techniques::SubLightUse;
  const SubLightUse use = technique.subLightUse(settings);
  if (use == SubLightUse::none || inputs.fit.empty) return nullptr;
  const std::string& asked = settings.choice("sub_lights");
  planner::SubLightNeeds needs = technique.subLightNeeds(settings, inputs.fit.mapSize);
  const int mapSize = needs.mapSize;
  int perSide = 1;
  if (asked != "auto") {
    std::from_chars(asked.data(), asked.data() + asked.size(), perSide);
  } else if (use == SubLightUse::automatic) {
    needs.widestPenumbraTexels = widestPenumbraTexels(inputs.fit, inputs.receiverFarDistance) *
                                 (static_cast<double>(mapSize) / inputs.fit.mapSize);
    const planner::SubLightChoice choice = planner::chooseSubLights(needs);
    perSide = choice.perSide;
    reason = choice.reason;
  }
  const planner::SubLightGrid grid = planner::subLightGrid(inputs.light, perSide);
  if (grid.whole()) return nullptr;
  const int side = planner::subLightMapSize(grid, mapSize, inputs.mostTexels);
  if (side == 0) {
    reason = "map-too-small: maps of " + std::to_string(grid.count()) +
             " sub-lights would have less than 64 texels a side; the light is seen whole";
    return nullptr;
  }
  if (contentKey_ != inputs.contentKey || mapSize_ != mapSize || split_.grid != grid) {
    split_ = planner::fitSubLights(inputs.light, inputs.casters, grid, side, fitter_, inputs.casterChanges);
    contentKey_ = inputs.contentKey;
    mapSize_ = mapSize;
  }
  // Who names a number wants its accuracy; `auto` weighs what it costs.
  split_.oneSearch = asked == "auto" && grid.hasMiddle();
  return split_.shared.empty ? nullptr : &split_;
}

}  // namespace halfshadow::api
