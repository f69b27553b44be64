// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "planner/light_space.hpp"
#include "techniques/parts/maps/light_depth.hpp"

namespace halfshadow::techniques {
namespace {
/// How far the ends of a vector in the light's plane are apart in the map, per unit of depth: tangents differ
/// by c (1 / z - 1 / z'), of which near (1 / z - 1 / z') is a difference of depths.
glm::dvec2 texelsPerDepth(const MapSpace& space, const glm::dvec2& vectorLight) {
  return space.texelsPerTangent * vectorLight / (space.nearDistance * space.depthUnit);
}
}  // namespace

std::vector<std::string> tileDefines(const LightDepth& depth) {
  if (depth.subLights == nullptr) return {};
  return {"HS_TILES " + std::to_string(depth.tilesPerSide()),
          "HS_MAPS " + std::to_string(depth.subLights->grid.count())};
}

glm::dvec4 subLightSteps(const LightDepth& depth) {
  const planner::SubLights& split = *depth.subLights;
  return {texelsPerDepth(depth.space, split.stepU), texelsPerDepth(depth.space, split.stepV)};
}

void addSubLights(const LightDepth& depth, ReceiverShading& shading) {
  if (depth.subLights == nullptr) return;
  const planner::SubLights& split = *depth.subLights;
  const MapSpace& space = depth.space;
  shading.defines.push_back("HS_SUB_LIGHTS_U " + std::to_string(split.grid.alongU));
  shading.defines.push_back("HS_SUB_LIGHTS_V " + std::to_string(split.grid.alongV));
  if (split.oneSearch) shading.defines.emplace_back("HS_ONE_SEARCH");
  const glm::dvec4 steps = subLightSteps(depth);
  const glm::dvec2 spread = glm::abs(glm::dvec2(steps)) * (0.5 * (split.grid.alongU - 1)) +
                            glm::abs(glm::dvec2(steps.z, steps.w)) * (0.5 * (split.grid.alongV - 1));
  shading.uniforms.set("u_subLightStep", glm::vec4(steps));
  shading.uniforms.set("u_subLights",
                       glm::vec4((1.0 - space.nearDistance / split.shared.alignedDistance) * space.depthUnit,
                                 std::max(spread.x, spread.y), 1.0 / depth.atlasSize, depth.tilesPerSide()));
  const glm::dvec2 whole = glm::max(split.shared.halfSize, glm::dvec2(1e-300));
  shading.uniforms.set("u_subLightShare", glm::vec4(split.halfSize / whole, 0.0, 0.0));
}

void addHorizon(const LightScene& scene, const LightDepth& depth, ReceiverShading& shading) {
  const planner::LightSpace space = planner::lightSpace(scene.light);
  const auto side = [&](const glm::dvec3& half) {
    const glm::dvec2 inPlane(glm::dot(space.axisX, half), glm::dot(space.axisY, half));
    return texelsPerDepth(depth.space, 2.0 * inPlane);
  };
  shading.uniforms.set("u_lightSides", glm::vec4(side(scene.light.halfU), side(scene.light.halfV)));
  if (!hasShortPrograms(scene)) shading.selfReceivers = ReceiverShading::SelfReceivers::casting;
  shading.itemUniforms = [](const DrawItem& item, device::UniformList& uniforms) {
    uniforms.set("u_receiver", glm::vec4(item.casts ? item.solidity : 0.0f, 0, 0, 0));
  };
}

}  // namespace halfshadow::techniques
