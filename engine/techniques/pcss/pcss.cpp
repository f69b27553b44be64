// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/pcss/pcss.hpp"

#include "techniques/parts/maps/light_blocks.hpp"
#include "techniques/parts/maps/map_shaders.hpp"
#include "techniques/parts/maps/one_view.hpp"

namespace halfshadow::techniques {
namespace {
class Pcss final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "pcss",
        .paper = "Fernando 2005; Evans, Agenjo, Blat 2014, section 3.2",
        .summary = "blocker search by taps, then a filter as wide as the penumbra",
        .guarantees = "umbra and lit regions are exact where the search region holds one kind of texel",
        .knownFailures =
            "one depth layer and one mean blocker: occluders at several heights share one width"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    return {{"pcss.search", SettingType::integer, "5", 3, 9, {}, "taps per side of the blocker search"},
            {"pcss.size", SettingType::integer, "7", 2, 17, {}, "taps per side of the filter"}};
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override { return standInForOneView(scene); }
  std::vector<ShaderFamily> shaderFamilies() const override {
    return mapReceiverFamilies(
        "map/pcss.frag",
        {range("HS_SEARCH", settings()[0], {3, 9}), range("HS_SPREAD_KERNEL", settings()[1], {2, 9, 17}),
         castingAxis(), subLightAxis(), flag("HS_SHORT")},
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
    shading = mapReceiverShading(scene, plan, depth, "map/pcss.frag");
    shading.defines.push_back("HS_SEARCH " + scene.settings.text("pcss.search"));
    shading.defines.push_back("HS_SPREAD_KERNEL " +
                              std::to_string(filterSide(depth, scene.settings.integer("pcss.size"))));
    addPenumbraBounds(scene, plan, depth, shading);
    if (hasShortPrograms(scene)) shading.defines.emplace_back("HS_SHORT");
    return {};
  }
};
}  // namespace

std::unique_ptr<Technique> makePcss() {
  return std::make_unique<Pcss>();
}

}  // namespace halfshadow::techniques
