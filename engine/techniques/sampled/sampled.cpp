// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/sampled/sampled.hpp"

#include <algorithm>
#include <cmath>

#include "techniques/parts/maps/light_depth.hpp"
#include "techniques/parts/maps/map_shaders.hpp"

namespace halfshadow::techniques {
namespace {
/// Additions of 1/255 that one 8-bit channel holds exactly, with some to spare.
constexpr int kSamplesPerChannel = 250;

/// Times as many texels a side as asked, of each of so many maps, where casters lie far off the light's axis.
constexpr int kMostGrowth = 2;

/// Points of the light, a and b in [-1, 1]: a rank-1 lattice, evenly spread for every count.
/// Based on: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018 (generalised golden
/// ratio).
glm::dvec2 samplePoint(int index) {
  const double x = std::fmod(0.5 + 0.7548776662466927 * (index + 1), 1.0);
  const double y = std::fmod(0.5 + 0.5698402909980532 * (index + 1), 1.0);
  return {2.0 * x - 1.0, 2.0 * y - 1.0};
}

class Sampled final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "sampled",
        .paper = "Haeberli, Akeley 1990 (accumulation of hard shadows)",
        .summary = "hard shadows from N points of the light, counted on the GPU and averaged",
        .guarantees = "counts are exact integers; converges to the truth as N and the map grow",
        .knownFailures = "costs N times hard; visibility is a multiple of 1/N"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    return {{"sampled.samples",
             SettingType::integer,
             "64",
             1,
             1000,
             {},
             "points of the light, one depth map each"}};
  }
  std::vector<ShaderFamily> shaderFamilies() const override {
    return joined({mapReceiverFamilies("map/hard.frag", {{{{"HS_COUNT_SHADOWED"}}}}),
                   receiverFamilies("screen/screen_counts.frag", {.forward = false})});
  }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<PlainPlanner<&plan>>();
  }

 private:
  static Status plan(const LightScene& scene, PassPlan& plan) {
    const int samples = scene.settings.integer("sampled.samples");
    const int width = scene.screen.width, height = scene.screen.height;
    const auto counts =
        plan.addImage({.name = scene.name + " sample counts", .width = width, .height = height});
    const auto depthTest = plan.addImage({.name = scene.name + " sample depth test",
                                          .width = width,
                                          .height = height,
                                          .format = framegraph::Format::depth24,
                                          .storage = framegraph::Storage::renderbuffer});
    for (int i = 0; i < samples; ++i) planSample(scene, plan, i, counts, depthTest);
    ReceiverShading& shading = plan.shading;
    shading.fragmentFile = "screen/screen_counts.frag";
    shading.forward = false;
    shading.textures = {{.sampler = "u_counts", .resource = counts}};
    shading.uniforms.set("u_samples", glm::vec4(255.0 / samples, 0, 0, 0));
    return {};
  }

  /// What the light shows from one of its points.
  static LightView sampleView(const LightScene& scene, int index) {
    scene::AreaLight point = scene.light;
    const glm::dvec2 at = samplePoint(index);
    point.centerWorld += at.x * scene.light.halfU + at.y * scene.light.halfV;
    point.halfU = point.halfV = glm::dvec3(0.0);
    const int mapSize = scene.settings.integer("map_size");
    return {.fit = planner::fitLight(point, scene.casterShapes,
                                     {.mapSize = std::min(scene.fit().mapSize, kMostGrowth * mapSize)}),
            .casters = scene.casters,
            .name = " sample " + std::to_string(index)};
  }

  static void planSample(const LightScene& scene, PassPlan& plan, int index, framegraph::ResourceId counts,
                         framegraph::ResourceId depthTest) {
    const LightDepth depth = planLightDepth(scene, sampleView(scene, index), plan, MapContent::casters);
    ReceiversDraw count{.shading = mapReceiverShading(scene, plan, depth, "map/hard.frag"),
                        .items = scene.receivers,
                        .target = {.depthIsComplete = true, .additive = true, .depthsApart = true}};
    count.shading.defines.push_back("HS_COUNT_SHADOWED");
    count.target.colorMask.fill(false);

    const auto initial = index == 0 ? framegraph::InitialContent::clear : framegraph::InitialContent::keep;
    PlannedPass pass{.name = scene.name + " count sample " + std::to_string(index),
                     .stage = framegraph::PassStage::light};
    pass.writes = {{.resource = counts, .point = framegraph::AttachmentPoint::color, .initial = initial},
                   {.resource = depthTest, .point = framegraph::AttachmentPoint::depth, .initial = initial}};
    if (index == 0) {
      // Depth first: what is covered later must not have been counted.
      ReceiversDraw depthOnly = count;
      depthOnly.target.depthIsComplete = depthOnly.target.additive = false;
      pass.draws.push_back({.what = std::move(depthOnly)});
    } else {
      pass.rebindReason = "one depth map at a time is counted; all of them would not fit in memory";
    }
    count.target.colorMask[static_cast<std::size_t>(index / kSamplesPerChannel)] = true;
    pass.draws.push_back({.what = std::move(count)});
    plan.passes.push_back(std::move(pass));
  }
};
}  // namespace

std::unique_ptr<Technique> makeSampled() {
  return std::make_unique<Sampled>();
}

}  // namespace halfshadow::techniques
