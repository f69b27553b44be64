// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_volume/shadow_volume.hpp"

#include <algorithm>

#include "techniques/shadow_volume/volume_count.hpp"

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
            "by blending",
        .takesOutlines = true};
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

  std::vector<ShaderFamily> shaderFamilies() const override {
    return joined(
        {{{"volume/volume.vert", "volume/volume.frag", {alphaAxis()}}, fullscreen("volume/volume.frag")},
         receiverFamilies("screen/screen_visibility.frag", {.forward = false})});
  }
  std::unique_ptr<LightPlanner> newPlanner() const override;
};

class VolumePlanner final : public LightPlanner {
 public:
  Status plan(const LightScene& scene, PassPlan& plan) override {
    const std::string& count = scene.settings.choice("shadow-volume.count");
    const bool hasStencil = scene.capabilities.has(device::Capability::packedDepthStencil);
    if (count == "stencil" && !hasStencil) {
      return Error{ErrorCode::capabilityMissing,
                   "shadow-volume.count=stencil needs the capability 'packed-depth-stencil', which this "
                   "driver lacks; set it to auto or blend"};
    }
    const VolumeCounter counter =
        count == "blend" || !hasStencil ? VolumeCounter::blend : VolumeCounter::stencil;
    const VolumeView view = volumeView(scene.screen);
    const LightVolumes volumes = lightVolumes(scene, plan, view, cache_, counter);
    const framegraph::ResourceId target = addScreenPass(scene, plan, view, counter);
    addVolumeCounts(plan, plan.passes.back(), volumes, counter, scene.channel);

    ReceiverShading& shading = plan.shading;
    shading.fragmentFile = "screen/screen_visibility.frag";
    shading.forward = false;
    shading.textures = {{.sampler = "u_screen", .resource = target}};
    shading.mapFromWorld = heightFromWorld(scene);
    glm::vec4 channel(0.0f);
    channel[scene.channel] = counter == VolumeCounter::stencil ? 1.0f : -255.0f;
    shading.uniforms.set("u_channel", channel);
    shading.uniforms.set("u_offset", counter == VolumeCounter::stencil ? 0.0f : 1.0f);
    return {};
  }

 private:
  /// The frame's one pass: receivers' depths, then each light's count, without leaving the framebuffer.
  static framegraph::ResourceId addScreenPass(const LightScene& scene, PassPlan& plan, const VolumeView& view,
                                              VolumeCounter counter) {
    const bool stencil = counter == VolumeCounter::stencil;
    const int width = scene.screen.width, height = scene.screen.height;
    const auto target = plan.addSharedImage({.name = kTargetName, .width = width, .height = height});
    const auto depth = plan.addSharedImage(
        {.name = "shadow volumes depth",
         .width = width,
         .height = height,
         .format = stencil ? framegraph::Format::depth24Stencil8 : framegraph::Format::depth24,
         .storage = framegraph::Storage::renderbuffer});
    framegraph::ClearValue clear;
    if (stencil) std::ranges::fill(clear.color, 1.0f);
    PlannedPass pass{.name = kPassName, .stage = framegraph::PassStage::receiverPrepass};
    pass.writes = {
        {.resource = target, .point = framegraph::AttachmentPoint::color, .clear = clear},
        {.resource = depth,
         .point = stencil ? framegraph::AttachmentPoint::depthStencil : framegraph::AttachmentPoint::depth,
         .clear = clear}};
    pass.draws.push_back(volumeReceivers(plan, view, scene.receivers));
    pass.drawsForAllLights = pass.draws.size();
    plan.passes.push_back(std::move(pass));
    return target;
  }

  VolumeCache cache_;
};

std::unique_ptr<LightPlanner> ShadowVolume::newPlanner() const {
  return std::make_unique<VolumePlanner>();
}
}  // namespace

std::unique_ptr<Technique> makeShadowVolume() {
  return std::make_unique<ShadowVolume>();
}

}  // namespace halfshadow::techniques
