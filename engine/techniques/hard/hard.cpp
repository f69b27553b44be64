// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/hard/hard.hpp"

#include "techniques/parts/maps/light_depth.hpp"
#include "techniques/parts/maps/map_shaders.hpp"

namespace halfshadow::techniques {
namespace {
class Hard final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{.id = "hard",
                                    .paper = "Williams 1978; Evans, Agenjo, Blat 2014, section 3.1",
                                    .summary = "one depth comparison per pixel, seen from the light's centre",
                                    .guarantees = "visibility is 0 or 1; no acne on closed casters at bias 1",
                                    .knownFailures = "no penumbra; edges are as coarse as the map's texels"};
    return info;
  }
  std::vector<ShaderFamily> shaderFamilies() const override {
    return mapReceiverFamilies("map/hard.frag", {subLightAxis()});
  }
  SubLightUse subLightUse(const Settings&) const override { return SubLightUse::whenAsked; }
  std::vector<Fallback> fallbacks() const override { return {shadedApart()}; }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<PlainPlanner<&plan>>();
  }

 private:
  static Status plan(const LightScene& scene, PassPlan& plan) {
    const LightDepth depth = planLightDepths(scene, plan, MapContent::casters);
    plan.shading = mapReceiverShading(scene, plan, depth, "map/hard.frag");
    return {};
  }
};
}  // namespace

std::unique_ptr<Technique> makeHard() {
  return std::make_unique<Hard>();
}

}  // namespace halfshadow::techniques
