// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/pcss_mip/pcss_mip.hpp"

#include "techniques/parts/maps/light_blocks.hpp"
#include "techniques/parts/maps/map_shaders.hpp"
#include "techniques/parts/maps/one_view.hpp"

namespace halfshadow::techniques {
namespace {
class PcssMip final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "pcss-mip",
        .paper = "Fernando 2005, with the blocker search replaced (Halfshadow)",
        .summary =
            "blocker search between two levels of an occupancy pyramid, then a filter as wide as the "
            "penumbra",
        .guarantees = "regions without casters cost at most two fetches",
        .knownFailures = "occluders at several heights share one width; receivers that cast search by taps"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    return {{"pcss-mip.size", SettingType::integer, "7", 2, 17, {}, "taps per side of the filter"}};
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override { return standInForOneView(scene); }
  std::vector<ShaderFamily> shaderFamilies() const override {
    return mapReceiverFamilies("map/pcss_mip.frag",
                               {range("HS_SPREAD_KERNEL", settings()[0], {2, 9, 17}),
                                {{{"HS_SEARCH 5"}}},
                                castingAxis(),
                                subLightAxis(),
                                flag("HS_SHORT")},
                               {.twoDraws = true});
  }
  std::vector<Fallback> fallbacks() const override { return penumbraFallbacks(); }
  SubLightUse subLightUse(const Settings&) const override { return SubLightUse::automatic; }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<PlainPlanner<&plan>>();
  }

 private:
  static Status plan(const LightScene& scene, PassPlan& plan) {
    const LightDepth depth = planLightDepths(scene, plan, MapContent::casters);
    ReceiverShading& shading = plan.shading;
    shading = mapReceiverShading(scene, plan, depth, "map/pcss_mip.frag");
    shading.defines.push_back("HS_SPREAD_KERNEL " +
                              std::to_string(filterSide(depth, scene.settings.integer("pcss-mip.size"))));
    addPenumbraBounds(scene, plan, depth, shading);
    return addBlockerSearch(scene, plan, depth);
  }
};
}  // namespace

std::unique_ptr<Technique> makePcssMip() {
  return std::make_unique<PcssMip>();
}

}  // namespace halfshadow::techniques
