// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/vsm/vsm.hpp"

#include <algorithm>

#include "base/keys.hpp"
#include "techniques/core/caster_spread.hpp"
#include "techniques/parts/maps/filter_pass.hpp"
#include "techniques/parts/maps/interiors.hpp"
#include "techniques/parts/maps/light_depth.hpp"
#include "techniques/parts/maps/map_shaders.hpp"

namespace halfshadow::techniques {
namespace {
/// Farthest over nearest caster: beyond, what stands beside the light takes so much of the map that the blur
/// is wider than the shadows.
constexpr double kWidestSpread = 100.0;

class Vsm final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "vsm",
        .paper = "Donnelly, Lauritzen 2006; Evans, Agenjo, Blat 2014, sections 3.2 and 4.2",
        .summary = "mean and variance of depth, blurred once, bound the lit share",
        .guarantees = "never darker than the blurred comparison it bounds",
        .knownFailures =
            "light bleeds where occluders overlap and along the edges at which they meet a receiver; with "
            "8-bit "
            "moments also wherever caster and receiver are close; lights whose farthest caster is over 100 "
            "times "
            "as far as the nearest, and rooms that the light is outside of, go to sampled"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    return {{"vsm.size", SettingType::integer, "7", 1, 33, {}, "side of the box blur in texels"},
            {"vsm.storage",
             SettingType::choice,
             "16",
             0,
             0,
             {"8", "16"},
             "bits per moment: 8 is what the paper's device had, 16 packs two bytes"}};
  }
  Support support(const device::Capabilities& capabilities) const override {
    if (capabilities.has(device::Capability::highp)) return {};
    return {false, "highp: the variance of two moments is below what fp16 resolves; use pcf or pcss-mip"};
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override {
    if (auto spread = sampledWhereCastersSpread(scene, kWidestSpread)) return spread;
    return standInForInteriors(scene);
  }
  std::vector<ShaderFamily> shaderFamilies() const override {
    return joined({{fullscreen("map/vsm_moments.frag", {depthAxis(), flag("HS_MOMENTS_8")}),
                    fullscreen("map/vsm_blur.frag",
                               {range("HS_KERNEL", settings()[0], {1, 3, 9, 33}), flag("HS_MOMENTS_8")})},
                   mapReceiverFamilies("map/vsm.frag", {flag("HS_MOMENTS_8"), {{{"HS_LIT_OUTSIDE"}}}})});
  }
  std::vector<Fallback> fallbacks() const override {
    return {shadedApart(), shadedApart({{"vsm.storage", "8"}}, "moments of 8 bits")};
  }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<PlainPlanner<&plan>>();
  }

 private:
  static Status plan(const LightScene& scene, PassPlan& plan) {
    const LightDepth depth = planLightDepth(scene, scene.center, plan, MapContent::castersAndReceivers);
    const bool bytes = scene.settings.choice("vsm.storage") == "8";
    const MapSpace& space = depth.space;
    // Beyond the casters by half their distance, or beyond the farthest receiver, both sides of the
    // comparison are clamped; no nearer than the casters' own range again, so that what lies close behind
    // them is told apart.
    const planner::LightFit& fit = scene.fit();
    const double beyond = std::max(scene.receiverFarDistance, 2.0 * fit.farthestCaster - fit.nearestCaster);
    const double deepest = std::min(1.5 * fit.farthestCaster, beyond);
    // As many digits as single precision has at that distance.
    const double extent = std::max(deepest - fit.nearestCaster, 1e-6 * deepest);
    const double quantum = bytes ? 1.0 / 255.0 : 1.0 / 65535.0;
    const double knob = scene.settings.real("bias");
    const glm::vec4 range(fit.nearestCaster / fit.nearDistance - 1.0, fit.nearDistance / extent,
                          2.0 * quantum, knob * 1.5 * quantum);

    std::vector<std::string> storage;
    if (bytes) storage.push_back("HS_MOMENTS_8");
    auto momentDefines = depthDefines(depth.storage);
    momentDefines.insert(momentDefines.end(), storage.begin(), storage.end());
    auto blurDefines = storage;
    blurDefines.push_back("HS_KERNEL " + scene.settings.text("vsm.size"));

    std::uint64_t key =
        combineKeys(depth.contentKey, (bytes ? 0x8u : 0x16u) + 256u * scene.settings.integer("vsm.size"));
    framegraph::ResourceId source = depth.map;
    const char* names[] = {" moments", " moments blurred along s", " moments blurred"};
    for (int step = 0; step < 3; ++step) {
      const std::string name = scene.name + names[step];
      const bool last = step == 2;
      const auto target =
          plan.addImage({.name = name,
                         .width = space.mapSize,
                         .height = space.mapSize,
                         .lifetime = framegraph::Lifetime::persistent,
                         .filter = last && bytes ? framegraph::Filter::linear : framegraph::Filter::nearest});
      const glm::vec4 direction(step == 1 ? 1 : 0, step == 2 ? 1 : 0, 0, 0);
      device::UniformList uniforms;
      uniforms.set("u_momentRange", range);
      uniforms.set("u_direction", direction);
      addFilterPass(plan,
                    {.name = name,
                     .fragmentFile = step == 0 ? "map/vsm_moments.frag" : "map/vsm_blur.frag",
                     .defines = step == 0 ? momentDefines : blurDefines,
                     .source = source,
                     .target = target,
                     .sourceSize = space.mapSize,
                     .contentKey = combineKeys(key, step),
                     .sampler = step == 0 ? device::UniformKey("u_depthMap") : device::UniformKey("u_source"),
                     .uniforms = std::move(uniforms)});
      source = target;
    }
    ReceiverShading& shading = plan.shading;
    shading = mapReceiverShading(scene, plan, depth, "map/vsm.frag");
    shading.textures[0] = {.sampler = "u_moments", .resource = source};
    shading.defines.insert(shading.defines.end(), storage.begin(), storage.end());
    shading.uniforms.set("u_momentRange", range);
    return {};
  }
};
}  // namespace

std::unique_ptr<Technique> makeVsm() {
  return std::make_unique<Vsm>();
}

}  // namespace halfshadow::techniques
