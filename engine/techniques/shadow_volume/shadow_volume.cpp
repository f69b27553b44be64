// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_volume/shadow_volume.hpp"

#include <algorithm>

#include "techniques/volumes/volume_count.hpp"

namespace halfshadow::techniques {
namespace {
constexpr const char* kPassName = "shadow volumes";
constexpr const char* kTargetName = "shadow volumes by light";

class ShadowVolume final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "shadow-volume",
        .paper = "Crow 1977; Everitt, Kilgard 2002 (depth-fail); Aldridge, Woods 2004 (any mesh)",
        .summary = "hard shadows of the light's centre, counted on the screen from the casters' silhouettes",
        .guarantees =
            "exact to the pixel, without bias or map; any mesh, any number of nested volumes, the camera "
            "inside volumes; a closed caster around the light's centre shadows all that lies outside of it",
        .knownFailures =
            "area lights shadow as their centre does; fills the screen with volumes; a pixel in "
            "whose view one caster's volume is entered over 95 times may be wrong when counted "
            "by blending"};
    return info;
  }

  std::vector<SettingInfo> settings() const override {
    return {{"shadow-volume.count",
             SettingType::choice,
             "auto",
             0,
             0,
             {"auto", "stencil", "blend"},
             "where volumes are counted: in the stencil buffer, or by blending into a colour channel, which "
             "needs no packed-depth-stencil; auto = stencil where it exists"}};
  }

  Result<ReceiverShading> declare(const LightFrame& frame) override {
    const std::string& count = frame.settings.choice("shadow-volume.count");
    const bool hasStencil = frame.capabilities.has(gl::Capability::packedDepthStencil);
    if (count == "stencil" && !hasStencil) {
      return Error{ErrorCode::capabilityMissing,
                   "shadow-volume.count=stencil needs the capability 'packed-depth-stencil', which this "
                   "driver lacks; set it to auto or blend"};
    }
    const VolumeCounter counter =
        count == "blend" || !hasStencil ? VolumeCounter::blend : VolumeCounter::stencil;
    auto programs = volumePrograms(frame.programs);
    if (!programs) return programs.error();
    const VolumeView view = volumeView(frame.view);
    auto volumes = prepareVolumes(frame, view, cache_, counter);
    if (!volumes) return volumes.error();
    const framegraph::ResourceId target = screenPass(frame, view, *programs, counter);
    jobs_->push_back({std::move(volumes).value(), frame.lightIndex});

    ReceiverShading shading;
    shading.fragmentFile = "screen_visibility.frag";
    shading.forward = false;
    shading.textures = {{.sampler = "u_screen", .resource = target}};
    shading.mapFromWorld = heightFromWorld(frame);
    glm::vec4 channel(0.0f);
    channel[frame.lightIndex] = counter == VolumeCounter::stencil ? 1.0f : -255.0f;
    const float offset = counter == VolumeCounter::stencil ? 0.0f : 1.0f;
    shading.setUniforms = [channel, offset](gl::Program& program, gl::Context& context) {
      program.set(context, "u_channel", channel);
      program.set(context, "u_offset", offset);
    };
    return shading;
  }

  void contextLost() override { cache_.clear(); }

 private:
  struct LightJob {
    LightVolumes volumes;
    int channel = 0;
  };

  /// The frame's one pass, declared with its first light: receivers' depths, then each light's count, without
  /// leaving the framebuffer.
  framegraph::ResourceId screenPass(const LightFrame& frame, const VolumeView& view,
                                    const VolumePrograms& programs, VolumeCounter counter) {
    const auto& resources = frame.graph.resources();
    const auto declared = std::ranges::find(resources, kTargetName, &framegraph::ResourceDesc::name);
    if (declared != resources.end())
      return {static_cast<std::uint32_t>(std::distance(resources.begin(), declared))};
    jobs_ = std::make_shared<std::vector<LightJob>>();
    const bool stencil = counter == VolumeCounter::stencil;
    const auto target = frame.graph.addResource(
        {.name = kTargetName, .width = frame.view.width, .height = frame.view.height});
    const auto depth = frame.graph.addResource(
        {.name = "shadow volumes depth",
         .width = frame.view.width,
         .height = frame.view.height,
         .format = stencil ? framegraph::Format::depth24Stencil8 : framegraph::Format::depth24,
         .storage = framegraph::Storage::renderbuffer});
    framegraph::ClearValue clear;
    if (stencil) std::ranges::fill(clear.color, 1.0f);
    framegraph::PassDesc pass{.name = kPassName, .stage = framegraph::PassStage::receiverPrepass};
    pass.writes = {
        {.resource = target, .point = framegraph::AttachmentPoint::color, .clear = clear},
        {.resource = depth,
         .point = stencil ? framegraph::AttachmentPoint::depthStencil : framegraph::AttachmentPoint::depth,
         .clear = clear}};
    pass.execute = [view, programs, counter, jobs = jobs_,
                    receivers = std::vector<DrawItem>(frame.receivers.begin(), frame.receivers.end())](
                       framegraph::PassContext& context) {
      drawVolumeReceivers(context, programs, view, receivers);
      for (const LightJob& job : *jobs) countVolumes(context, programs, job.volumes, counter, job.channel);
    };
    frame.graph.addPass(std::move(pass));
    return target;
  }

  VolumeCache cache_;
  std::shared_ptr<std::vector<LightJob>> jobs_;  ///< of the frame being declared
};
}  // namespace

std::unique_ptr<Technique> makeShadowVolume() {
  return std::make_unique<ShadowVolume>();
}

}  // namespace halfshadow::techniques
