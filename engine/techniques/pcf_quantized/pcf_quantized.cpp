// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/pcf_quantized/pcf_quantized.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "techniques/parts/maps/edge_mask.hpp"
#include "techniques/parts/maps/light_blocks.hpp"
#include "techniques/parts/maps/map_shaders.hpp"
#include "techniques/parts/maps/one_view.hpp"

namespace halfshadow::techniques {
namespace {

/// Sides of the three kernels, narrow to wide, from a choice such as "3/5/7".
std::array<int, 3> kernelSides(const std::string& text) {
  std::array<int, 3> sides{};
  const char* at = text.data();
  for (int& side : sides) at = std::from_chars(at, text.data() + text.size(), side).ptr + 1;
  return sides;
}

class PcfQuantized final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "pcf-quantized",
        .paper = "Evans, Agenjo, Blat 2014, section 4.4; bands in reciprocal depth: Halfshadow",
        .summary = "few kernel sizes, chosen per pixel by the quantised width of the penumbra",
        .guarantees = "regions without casters cost at most two fetches",
        .knownFailures =
            "a visible step where bands meet; preset=paper: corners and inner edges pick the wrong band"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    return {{"pcf-quantized.preset",
             SettingType::choice,
             "tuned",
             0,
             0,
             {"paper", "tuned"},
             "paper: Laplacian strength in three channels; tuned: width by averaged blockers"},
            {"pcf-quantized.kernels",
             SettingType::choice,
             "3/5/7",
             0,
             0,
             {"2/3/5", "3/5/7", "5/7/9"},
             "taps per side of the three kernels"},
            {"pcf-quantized.bands",
             SettingType::integer,
             "64",
             3,
             64,
             {},
             "bands of the penumbra's width (tuned)"},
            {"pcf-quantized.filter",
             SettingType::choice,
             "laplacian5",
             0,
             0,
             {"laplacian5", "laplacian9"},
             "edge filter of preset=paper"}};
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override {
    // The paper's bands are far from the truth in any case.
    if (scene.settings.choice("pcf-quantized.preset") == "paper") return std::nullopt;
    return standInForOneView(scene);
  }
  std::vector<ShaderFamily> shaderFamilies() const override {
    return joined({mapReceiverFamilies("map/pcf_quantized.frag",
                                       {range("HS_SPREAD_KERNEL", 3, 9, {4, 7}),
                                        {{{"HS_SEARCH 5"}}},
                                        castingAxis(),
                                        subLightAxis(),
                                        flag("HS_SHORT")},
                                       {.twoDraws = true}),
                   mapReceiverFamilies("map/pcf_quantized_paper.frag",
                                       {values("HS_SPREAD_KERNEL", {5, 7, 9}), {{{"HS_LIT_OUTSIDE"}}}})});
  }
  std::vector<Fallback> fallbacks() const override { return penumbraFallbacks(); }
  SubLightUse subLightUse(const Settings& settings) const override {
    return settings.choice("pcf-quantized.preset") == "paper" ? SubLightUse::none : SubLightUse::automatic;
  }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<PlainPlanner<&plan>>();
  }

 private:
  static Status plan(const LightScene& scene, PassPlan& plan) {
    return scene.settings.choice("pcf-quantized.preset") == "paper" ? planPaper(scene, plan)
                                                                    : planTuned(scene, plan);
  }

  static Status planPaper(const LightScene& scene, PassPlan& plan) {
    // The paper's map holds the whole scene: an edge's strength is the step from caster to receiver.
    const LightDepth depth = planLightDepth(scene, scene.center, plan, MapContent::castersAndReceivers);
    const auto sides = kernelSides(scene.settings.choice("pcf-quantized.kernels"));
    // The paper's thresholds .2, .5, .8 are kept; the strength is scaled so that 1 is the depth step whose
    // penumbra is as wide as the largest kernel.
    const double strength =
        std::max(depth.space.kernelTexelsPerDepth.x, depth.space.kernelTexelsPerDepth.y) / sides[2];
    auto mask = planEdgeMask(
        scene, plan, depth,
        {.filter = scene.settings.choice("pcf-quantized.filter") == "laplacian9" ? EdgeFilter::laplacian9
                                                                                 : EdgeFilter::laplacian5,
         .radiusTexels = 0.5 * sides[2],
         .strengthPerDepth = std::max(strength, 1e-6)});
    if (!mask) return mask.error();
    ReceiverShading& shading = plan.shading;
    shading = mapReceiverShading(scene, plan, depth, "map/pcf_quantized_paper.frag");
    addEdgeMask(shading, *mask);
    addKernels(shading, sides);
    return {};
  }

  static Status planTuned(const LightScene& scene, PassPlan& plan) {
    const LightDepth depth = planLightDepths(scene, plan, MapContent::casters);
    ReceiverShading& shading = plan.shading;
    shading = mapReceiverShading(scene, plan, depth, "map/pcf_quantized.frag");
    addPenumbraBounds(scene, plan, depth, shading);
    if (Status s = addBlockerSearch(scene, plan, depth); !s) return s;
    std::array<int, 3> sides = kernelSides(scene.settings.choice("pcf-quantized.kernels"));
    for (int& side : sides) side = filterSide(depth, side);
    addKernels(shading, sides);

    // Bands evenly apart in octaves from the widest penumbra that this frame can have down to two texels, at
    // most half an octave apart. A caster close to the light makes that width huge and rare: then all bands
    // are spread.
    const MapSpace& space = depth.space;
    const double widest = std::clamp(widestPenumbraTexels(scene, space), 2.0, 4.0 * space.mapSize);
    const int bands = scene.settings.integer("pcf-quantized.bands");
    const double evenly = std::log2(widest / 2.0) / (bands - 1);
    const double octavesApart = widest > 0.4 * space.mapSize ? evenly : std::min(evenly, 0.5);
    const double narrowest = std::max(widest * std::exp2(-octavesApart * (bands - 1)), 1.0);
    const double octaves = std::max(std::log2(widest / narrowest), 1e-3);
    const glm::vec4 bandUniform(std::log2(narrowest), (bands - 1) / octaves, bands - 1, 0.0);
    shading.uniforms.set("u_bands", bandUniform);
    return {};
  }

  static void addKernels(ReceiverShading& shading, const std::array<int, 3>& sides) {
    shading.defines.push_back("HS_SPREAD_KERNEL " + std::to_string(sides[2]));
    const glm::vec4 kernels(sides[0], sides[1], sides[2], 0);
    shading.uniforms.set("u_kernels", kernels);
  }
};

}  // namespace

std::unique_ptr<Technique> makePcfQuantized() {
  return std::make_unique<PcfQuantized>();
}

}  // namespace halfshadow::techniques
