// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/vsm/vsm.hpp"

#include <algorithm>

#include "planner/frame_planner.hpp"
#include "techniques/core/caster_spread.hpp"
#include "techniques/light_blocks/interiors.hpp"
#include "techniques/light_blocks/light_blocks.hpp"

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
  Support support(const gl::Capabilities& capabilities) const override {
    if (capabilities.has(gl::Capability::highp)) return {};
    return {false, "highp: the variance of two moments is below what fp16 resolves; use pcf or pcss-mip"};
  }
  std::optional<StandIn> standIn(const LightFrame& frame) const override {
    if (auto spread = sampledWhereCastersSpread(frame, kWidestSpread)) return spread;
    return standInForInteriors(frame);
  }
  Result<ReceiverShading> declare(const LightFrame& frame) override {
    auto depth = declareLightDepth(frame, MapContent::castersAndReceivers);
    if (!depth) return depth.error();
    const bool bytes = frame.settings.choice("vsm.storage") == "8";
    const MapSpace& space = depth->space;
    // Beyond the casters by half their distance, or beyond the farthest receiver, both sides of the
    // comparison are clamped; no nearer than the casters' own range again, so that what lies close behind
    // them is told apart.
    const planner::LightFit& fit = frame.fit;
    const double beyond = std::max(frame.receiverFarDistance, 2.0 * fit.farthestCaster - fit.nearestCaster);
    const double deepest = std::min(1.5 * fit.farthestCaster, beyond);
    // As many digits as single precision has at that distance.
    const double extent = std::max(deepest - fit.nearestCaster, 1e-6 * deepest);
    const double quantum = bytes ? 1.0 / 255.0 : 1.0 / 65535.0;
    const double knob = frame.settings.real("bias");
    const glm::vec4 range(fit.nearestCaster / fit.nearDistance - 1.0, fit.nearDistance / extent,
                          2.0 * quantum, knob * 1.5 * quantum);

    std::vector<std::string> storage;
    if (bytes) storage.push_back("HS_MOMENTS_8");
    auto momentDefines = depthDefines(depth->storage);
    momentDefines.insert(momentDefines.end(), storage.begin(), storage.end());
    auto blurDefines = storage;
    blurDefines.push_back("HS_KERNEL " + frame.settings.text("vsm.size"));
    auto moments = frame.programs.get({"fullscreen.vert", "vsm_moments.frag", momentDefines});
    if (!moments) return moments.error();
    auto blur = frame.programs.get({"fullscreen.vert", "vsm_blur.frag", blurDefines});
    if (!blur) return blur.error();

    std::uint64_t key = planner::combineKeys(
        depth->contentKey, (bytes ? 0x8u : 0x16u) + 256u * frame.settings.integer("vsm.size"));
    framegraph::ResourceId source = depth->map;
    const char* names[] = {" moments", " moments blurred along s", " moments blurred"};
    for (int step = 0; step < 3; ++step) {
      const std::string name = "light " + std::to_string(frame.lightIndex) + names[step];
      const bool last = step == 2;
      const auto target = frame.graph.addResource(
          {.name = name,
           .width = space.mapSize,
           .height = space.mapSize,
           .lifetime = framegraph::Lifetime::persistent,
           .filter = last && bytes ? framegraph::Filter::linear : framegraph::Filter::nearest});
      const glm::vec4 direction(step == 1 ? 1 : 0, step == 2 ? 1 : 0, 0, 0);
      addFilterPass(frame.graph,
                    {.name = name,
                     .program = step == 0 ? *moments : *blur,
                     .source = source,
                     .target = target,
                     .sourceSize = space.mapSize,
                     .contentKey = planner::combineKeys(key, step),
                     .sampler = step == 0 ? gl::UniformKey("u_depthMap") : gl::UniformKey("u_source"),
                     .setUniforms = [range, direction](gl::Program& program, gl::Context& context) {
                       program.set(context, "u_momentRange", range);
                       program.set(context, "u_direction", direction);
                     }});
      source = target;
    }
    ReceiverShading shading = mapReceiverShading(frame, *depth, "vsm.frag");
    shading.textures[0] = {.sampler = "u_moments", .resource = source};
    shading.defines.insert(shading.defines.end(), storage.begin(), storage.end());
    shading.setUniforms = [range, inner = std::move(shading.setUniforms)](gl::Program& program,
                                                                          gl::Context& context) {
      inner(program, context);
      program.set(context, "u_momentRange", range);
    };
    return shading;
  }
};
}  // namespace

std::unique_ptr<Technique> makeVsm() {
  return std::make_unique<Vsm>();
}

}  // namespace halfshadow::techniques
