// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/pcf/pcf.hpp"

#include "techniques/parts/maps/edge_mask.hpp"
#include "techniques/parts/maps/light_blocks.hpp"
#include "techniques/parts/maps/map_shaders.hpp"
#include "techniques/parts/maps/poisson_disc.hpp"

namespace halfshadow::techniques {
namespace {

std::vector<SettingInfo> kernelSettings(const std::string& id) {
  return {{id + ".size",
           SettingType::integer,
           "4",
           2,
           17,
           {},
           "kernel side in texels (grid), disc diameter (poisson)"},
          {id + ".pattern",
           SettingType::choice,
           "grid",
           0,
           0,
           {"grid", "poisson"},
           "size x size grid, or a Poisson disc"},
          {id + ".taps", SettingType::integer, "16", 4, 64, {}, "taps of the Poisson disc"},
          {id + ".rotate",
           SettingType::choice,
           "off",
           0,
           0,
           {"off", "on"},
           "turn the Poisson disc from pixel to pixel"}};
}

/// Radius in texels beyond which the kernel takes no tap, texel centring included.
double kernelRadiusTexels(const LightScene& scene, const std::string& id) {
  const int size = scene.settings.integer(id + ".size");
  // A disc's points leave the unit disc a little when they are centred; a tap moves to its texel's centre.
  return scene.settings.choice(id + ".pattern") == "poisson" ? 0.5 * size * 1.25 + 0.75 : 0.5 * size + 0.5;
}

ReceiverShading kernelShading(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                              const std::string& id, std::string fragmentFile) {
  const Settings& settings = scene.settings;
  ReceiverShading shading = mapReceiverShading(scene, plan, depth, std::move(fragmentFile));
  if (settings.choice(id + ".pattern") == "grid") {
    shading.defines.push_back("HS_KERNEL " + settings.text(id + ".size"));
    return shading;
  }
  const int taps = settings.integer(id + ".taps");
  shading.defines.push_back("HS_POISSON_COUNT " + std::to_string(taps));
  shading.defines.push_back(poissonTapsDefine(taps));
  if (settings.choice(id + ".rotate") == "on") shading.defines.push_back("HS_ROTATE");
  const glm::vec4 poisson(0.5 * settings.integer(id + ".size"), 0, 0, 0);
  shading.uniforms.set("u_poisson", poisson);
  return shading;
}

/// The grid, or a disc whose points are text.
ShaderAxis kernelAxis() {
  const std::vector<SettingInfo> settings = kernelSettings("");
  ShaderAxis axis = range("HS_KERNEL", settings[0], {2, 7, 17});
  for (const device::ShaderChoice& count : range("HS_POISSON_COUNT", settings[2], {})) {
    axis.push_back({{count.defines[0], "HS_POISSON_TAPS(TAP) *"}, {}, false});
    axis.push_back(axis.back());
    axis.back().defines.emplace_back("HS_ROTATE");
  }
  const std::vector<std::string> disc = {"HS_POISSON_COUNT 16", poissonTapsDefine(16)};
  axis.push_back({disc});
  axis.push_back({{disc[0], disc[1], "HS_ROTATE"}});
  return axis;
}

class Pcf final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "pcf",
        .paper = "Reeves, Salesin, Cook 1987; Evans, Agenjo, Blat 2014, section 3.2",
        .summary = "mean of depth comparisons over a fixed kernel",
        .guarantees = "visibility is a multiple of 1/taps",
        .knownFailures = "the penumbra is as wide everywhere, whatever the light's size"};
    return info;
  }
  std::vector<SettingInfo> settings() const override { return kernelSettings("pcf"); }
  std::vector<ShaderFamily> shaderFamilies() const override {
    return mapReceiverFamilies("map/pcf.frag", {kernelAxis(), subLightAxis()});
  }
  SubLightUse subLightUse(const Settings&) const override { return SubLightUse::whenAsked; }
  std::vector<Fallback> fallbacks() const override {
    return {
        shadedApart(), shadedApart({{"sub_lights", "1"}}, "one map of the whole light"),
        shadedApart({{"sub_lights", "1"}, {"pcf.pattern", "grid"}, {"pcf.size", "4"}}, "16 taps of one map"),
        shadedApart({{"sub_lights", "1"}, {"pcf.pattern", "grid"}, {"pcf.size", "2"}}, "4 taps of one map")};
  }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<PlainPlanner<&plan>>();
  }

 private:
  static Status plan(const LightScene& scene, PassPlan& plan) {
    const LightDepth depth = planLightDepths(scene, plan, MapContent::casters);
    plan.shading = kernelShading(scene, plan, depth, "pcf", "map/pcf.frag");
    return {};
  }
};

class PcfMasked final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "pcf-masked",
        .paper = "Evans, Agenjo, Blat 2014, section 4.3; Sander et al. 2005; block bounds: Halfshadow",
        .summary = "pcf, filtered only where a mask says that taps can differ",
        .guarantees = "mask=minmax: the image of pcf in every pixel",
        .knownFailures = "the paper's Laplacian masks miss edges (mask=laplacian5, laplacian9)"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    auto settings = kernelSettings("pcf-masked");
    settings.push_back({"pcf-masked.mask",
                        SettingType::choice,
                        "minmax",
                        0,
                        0,
                        {"minmax", "laplacian5", "laplacian9"},
                        "conservative block bounds, or the paper's edge filter of 5 or 9 taps"});
    settings.push_back(
        {"pcf-masked.skip",
         SettingType::choice,
         "auto",
         0,
         0,
         {"branch", "loop", "stencil", "auto"},
         "how unfiltered pixels skip the taps; auto: what the device profile measured as fastest"});
    return settings;
  }
  std::vector<ShaderFamily> shaderFamilies() const override {
    return mapReceiverFamilies(
        "map/pcf_masked.frag",
        {kernelAxis(), flag("HS_MASK_EDGES"),
         flag("HS_SKIP_LOOP", {"HS_KERNEL", "!HS_PHASE_CLASSIFY", "!HS_PHASE_FILTER"})},
        {.twoDraws = true});
  }
  std::vector<Fallback> fallbacks() const override {
    return {shadedApart(), {.text = "every pixel is filtered", .technique = "pcf"}};
  }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<PlainPlanner<&plan>>();
  }

 private:
  static Status plan(const LightScene& scene, PassPlan& plan) {
    const Settings& settings = scene.settings;
    const LightDepth depth = planLightDepth(scene, scene.center, plan, MapContent::casters);
    ReceiverShading& shading = plan.shading;
    shading = kernelShading(scene, plan, depth, "pcf-masked", "map/pcf_masked.frag");
    const double radius = kernelRadiusTexels(scene, "pcf-masked");
    if (settings.choice("pcf-masked.mask") == "minmax") {
      addBlockMask(shading, planBlockBounds(scene, plan, depth, radius));
    } else {
      const EdgeFilter filter = settings.choice("pcf-masked.mask") == "laplacian5" ? EdgeFilter::laplacian5
                                                                                   : EdgeFilter::laplacian9;
      auto mask = planEdgeMask(scene, plan, depth, {.filter = filter, .radiusTexels = radius});
      if (!mask) return mask.error();
      shading.defines.push_back("HS_MASK_EDGES");
      addEdgeMask(shading, *mask);
    }
    const std::string& skip = settings.choice("pcf-masked.skip");
    shading.skip = skip == "auto" ? preferredSkip(scene) : filterSkipFromName(skip);
    if (shading.skip == FilterSkip::loop && settings.choice("pcf-masked.pattern") == "poisson") {
      shading.skip = FilterSkip::branch;  // the disc's taps are unrolled: there is no loop to bound
    }
    if (shading.skip == FilterSkip::loop) shading.defines.push_back("HS_SKIP_LOOP");
    return {};
  }
};

}  // namespace

std::unique_ptr<Technique> makePcf() {
  return std::make_unique<Pcf>();
}
std::unique_ptr<Technique> makePcfMasked() {
  return std::make_unique<PcfMasked>();
}

}  // namespace halfshadow::techniques
