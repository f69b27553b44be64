// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/wedges/wedge_passes.hpp"

#include <algorithm>

namespace halfshadow::techniques {
using framegraph::Attachment;
using framegraph::AttachmentPoint;
using framegraph::InitialContent;
using framegraph::ResourceId;

ReceiverShading screenShading(const LightScene& scene, ResourceId image, float steps) {
  ReceiverShading shading;
  shading.fragmentFile = "wedge/screen_wedges.frag";
  shading.forward = false;
  shading.mapFromWorld = heightFromWorld(scene);
  shading.textures = {{.sampler = "u_wedges", .resource = image}};
  if (steps > 0.0f) shading.defines.push_back("HS_WEDGE_SUMS");
  shading.uniforms.set("u_wedgeSteps", glm::vec4(steps, 0, 0, 0));
  return shading;
}

ReceiverShading shareShading(const LightScene& scene, ResourceId image) {
  ReceiverShading shading = screenShading(scene, image, 0.0f);
  shading.defines = {"HS_WEDGE_SHARES"};
  return shading;
}

ScreenWalk ownWalk(const ReceiverShading& shading) {
  ScreenWalk walk{.fragmentFile = "list/own_cells.frag", .defines = {"HS_CELLS 16", "HS_WHOLE_LIGHT"}};
  if (std::ranges::find(shading.defines, "HS_WEDGE_SUMS") != shading.defines.end())
    walk.defines.push_back("HS_SUM_CASTERS");
  return walk;
}

ResourceId screenImage(const LightScene& scene, PassPlan& plan, const std::string& name) {
  return plan.addImage(
      {.name = scene.name + " " + name, .width = scene.screen.width, .height = scene.screen.height});
}

std::vector<Attachment> wedgeTargets(ResourceId color, const ReceiverDepth& depth, InitialContent initial,
                                     float clear) {
  return {{.resource = color,
           .point = AttachmentPoint::color,
           .initial = initial,
           .clear = {.color = {clear, clear, clear, clear}}},
          {.resource = depth.depthTest, .point = AttachmentPoint::depth, .initial = InitialContent::keep}};
}

void addClipDefines(const LightScene& scene, std::vector<std::string>& defines) {
  defines.emplace_back("HS_WEDGE_CLIP");
  if (hasShortPrograms(scene)) defines.emplace_back("HS_WEDGE_CHAIN");
}

void addVolumes(const LightScene& scene, PassPlan& plan, PlannedPass& pass, const Wedges& wedges,
                std::vector<std::string> defines, std::span<const CasterRange> casters,
                const device::BlendState& blend, float steps) {
  for (const WedgePart part : {WedgePart::beyond, WedgePart::beside}) {
    if (part == WedgePart::beside) addClipDefines(scene, defines);
    PlannedDraw draw{.program =
                         plan.addProgram({"wedge/wedge_volume.vert", "wedge/wedge_piece.frag", defines})};
    draw.uniforms.set("u_wedgeSteps", glm::vec4(steps, wedges.volumes->trimmed ? 1.0f : 0.0f, 0, 0));
    draw.state.blend = blend;
    addWedgeVolumes(pass, std::move(draw), *wedges.volumes, wedges.depth, scene.screen, casters, part);
  }
}

}  // namespace halfshadow::techniques
