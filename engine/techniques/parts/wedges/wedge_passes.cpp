// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/wedges/wedge_passes.hpp"

namespace halfshadow::techniques {
using framegraph::Attachment;
using framegraph::AttachmentPoint;
using framegraph::InitialContent;
using framegraph::ResourceId;

std::string wedgePassName(const LightFrame& frame, const std::string& what) {
  return "light " + std::to_string(frame.lightIndex) + " " + what;
}

ReceiverShading screenShading(const LightFrame& frame, ResourceId image, float steps) {
  ReceiverShading shading;
  shading.fragmentFile = "wedge/screen_wedges.frag";
  shading.forward = false;
  shading.mapFromWorld = heightFromWorld(frame);
  shading.textures = {{.sampler = "u_wedges", .resource = image}};
  if (steps > 0.0f) shading.defines.push_back("HS_WEDGE_SUMS");
  shading.setUniforms = [steps](gl::Program& program, gl::Context& context) {
    program.set(context, "u_wedgeSteps", glm::vec4(steps, 0, 0, 0));
  };
  return shading;
}

ReceiverShading shareShading(const LightFrame& frame, ResourceId image) {
  ReceiverShading shading = screenShading(frame, image, 0.0f);
  shading.defines = {"HS_WEDGE_SHARES"};
  return shading;
}

ResourceId screenImage(const LightFrame& frame, const std::string& name) {
  return frame.graph.addResource({.name = "light " + std::to_string(frame.lightIndex) + " " + name,
                                  .width = frame.screen.width,
                                  .height = frame.screen.height});
}

std::vector<Attachment> wedgeTargets(ResourceId color, const ReceiverDepth& depth, InitialContent initial,
                                     float clear) {
  return {{.resource = color,
           .point = AttachmentPoint::color,
           .initial = initial,
           .clear = {.color = {clear, clear, clear, clear}}},
          {.resource = depth.depthTest, .point = AttachmentPoint::depth, .initial = InitialContent::keep}};
}

Result<PiecePrograms> piecePrograms(const LightFrame& frame, std::vector<std::string> defines) {
  PiecePrograms programs;
  for (gl::Program** program : {&programs.beyond, &programs.beside}) {
    auto linked = frame.programs.get({"wedge/wedge_volume.vert", "wedge/wedge_piece.frag", defines});
    if (!linked) return linked.error();
    *program = *linked;
    defines.push_back("HS_WEDGE_CLIP");
  }
  return programs;
}

void addVolumes(framegraph::PassContext& context, const PiecePrograms& programs, const Wedges& wedges,
                const View& view, std::span<const CasterRange> casters, const gl::BlendState& blend,
                float steps) {
  for (const WedgePart part : {WedgePart::beyond, WedgePart::beside}) {
    gl::Program& program = part == WedgePart::beyond ? *programs.beyond : *programs.beside;
    context.encoder.useProgram(program);
    program.set(context.encoder.context(), "u_wedgeSteps",
                glm::vec4(steps, wedges.volumes->trimmed ? 1.0f : 0.0f, 0, 0));
    drawWedgeVolumes(context, program, *wedges.volumes, wedges.depth, view, casters, part, {.blend = blend});
  }
}

}  // namespace halfshadow::techniques
