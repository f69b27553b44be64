// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/screen/visibility_parts.hpp"

#include <algorithm>

namespace halfshadow::techniques {

void planVisibilityParts(const LightScene& scene, PassPlan& plan, std::vector<ReceiverShading> parts) {
  const std::size_t count = std::min(parts.size(), kMostVisibilityParts);
  const int width = scene.screen.width, height = scene.screen.height;
  const auto image =
      plan.addImage({.name = scene.name + " visibility in parts", .width = width, .height = height});
  const auto depth = plan.addImage({.name = scene.name + " depth of parts",
                                    .width = width,
                                    .height = height,
                                    .format = framegraph::Format::depth24,
                                    .storage = framegraph::Storage::renderbuffer});
  PlannedPass pass{.name = scene.name + " visibility in parts",
                   .stage = framegraph::PassStage::receiverPrepass};
  pass.writes = {{.resource = image, .point = framegraph::AttachmentPoint::color},
                 {.resource = depth, .point = framegraph::AttachmentPoint::depth}};
  glm::vec4 channels(0.0f);
  for (std::size_t i = 0; i < count; ++i) {
    ReceiversDraw draw{.shading = std::move(parts[i]), .items = scene.receivers};
    draw.shading.skip = FilterSkip::none;
    draw.target.colorMask = {i == 0, i == 1, i == 2, i == 3};
    draw.target.depthIsComplete = i > 0;
    channels[static_cast<int>(i)] = 1.0f;
    pass.draws.push_back({.what = std::move(draw)});
  }
  plan.passes.push_back(std::move(pass));

  ReceiverShading shading;
  shading.fragmentFile = "screen/screen_visibility.frag";
  shading.forward = false;
  shading.mapFromWorld = heightFromWorld(scene);
  shading.textures = {{.sampler = "u_screen", .resource = image}};
  shading.uniforms.set("u_channel", channels);
  shading.uniforms.set("u_offset", 1.0f - static_cast<float>(count));
  plan.shading = std::move(shading);
}

}  // namespace halfshadow::techniques
