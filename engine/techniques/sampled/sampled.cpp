// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/sampled/sampled.hpp"

#include <cmath>

#include "techniques/core/receiver_pass.hpp"
#include "techniques/parts/maps/light_depth.hpp"

namespace halfshadow::techniques {
namespace {
/// Additions of 1/255 that one 8-bit channel holds exactly, with some to spare.
constexpr int kSamplesPerChannel = 250;

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
  Result<ReceiverShading> declare(const LightFrame& frame) override {
    const int samples = frame.settings.integer("sampled.samples");
    const std::string prefix = "light " + std::to_string(frame.lightIndex);
    const int width = frame.view.width, height = frame.view.height;
    const auto counts =
        frame.graph.addResource({.name = prefix + " sample counts", .width = width, .height = height});
    const auto depthTest = frame.graph.addResource({.name = prefix + " sample depth test",
                                                    .width = width,
                                                    .height = height,
                                                    .format = framegraph::Format::depth24,
                                                    .storage = framegraph::Storage::renderbuffer});
    for (int i = 0; i < samples; ++i) {
      if (Status s = declareSample(frame, i, counts, depthTest); !s) return s.error();
    }
    ReceiverShading shading;
    shading.fragmentFile = "screen/screen_counts.frag";
    shading.forward = false;
    shading.textures = {{.sampler = "u_counts", .resource = counts}};
    const glm::vec4 scale(255.0 / samples, 0, 0, 0);
    shading.setUniforms = [scale](gl::Program& program, gl::Context& context) {
      program.set(context, "u_samples", scale);
    };
    return shading;
  }

 private:
  static Status declareSample(const LightFrame& frame, int index, framegraph::ResourceId counts,
                              framegraph::ResourceId depthTest) {
    scene::AreaLight point = frame.light;
    const glm::dvec2 at = samplePoint(index);
    point.centerWorld += at.x * frame.light.halfU + at.y * frame.light.halfV;
    point.halfU = point.halfV = glm::dvec3(0.0);
    const planner::LightFit fit =
        planner::fitLight(point, frame.casterPointsWorld, {.mapSize = frame.fit.mapSize});
    LightFrame sample = frame;
    sample.fit = fit;
    sample.mapName = " sample " + std::to_string(index);
    sample.mapLifetime = framegraph::Lifetime::transient;
    sample.contentKey = sample.sceneKey = 0;
    auto depth = declareLightDepth(sample, MapContent::casters);
    if (!depth) return depth.error();
    ReceiverShading shading = mapReceiverShading(sample, *depth, "map/hard.frag");
    shading.defines.push_back("HS_COUNT_SHADOWED");
    auto programs = receiverPrograms(frame.programs, shading, ReceiverOutput::visibility, frame.receivers);
    if (!programs) return programs.error();

    framegraph::PassDesc pass{
        .name = "light " + std::to_string(frame.lightIndex) + " count sample " + std::to_string(index),
        .stage = framegraph::PassStage::light,
        .reads = resourcesRead(shading)};
    const auto initial = index == 0 ? framegraph::InitialContent::clear : framegraph::InitialContent::keep;
    pass.writes = {{.resource = counts, .point = framegraph::AttachmentPoint::color, .initial = initial},
                   {.resource = depthTest, .point = framegraph::AttachmentPoint::depth, .initial = initial}};
    if (index > 0)
      pass.rebindReason = "one depth map at a time is counted; all of them would not fit in memory";
    ReceiverTarget target{.depthIsComplete = true, .additive = true, .depthsApart = true};
    target.colorMask.fill(false);
    target.colorMask[static_cast<std::size_t>(index / kSamplesPerChannel)] = true;
    pass.execute = [shading, programs = *programs, &view = frame.view, target, first = index == 0,
                    items = std::vector<DrawItem>(frame.receivers.begin(), frame.receivers.end())](
                       framegraph::PassContext& context) {
      // Depth first: what is covered later must not have been counted.
      if (first) {
        const ReceiverTarget depthOnly{.colorMask = {false, false, false, false}, .depthsApart = true};
        drawReceivers(context, shading, programs, view, items, nullptr, depthOnly);
      }
      drawReceivers(context, shading, programs, view, items, nullptr, target);
    };
    frame.graph.addPass(std::move(pass));
    return {};
  }
};
}  // namespace

std::unique_ptr<Technique> makeSampled() {
  return std::make_unique<Sampled>();
}

}  // namespace halfshadow::techniques
