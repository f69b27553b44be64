// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/receiver_depth/receiver_depth.hpp"

#include <algorithm>

namespace halfshadow::techniques {
namespace {
constexpr const char* kName = "receiver depth";

glm::dvec4 row(const glm::dmat4& m, int index) {
  return {m[0][index], m[1][index], m[2][index], m[3][index]};
}

/// The same projection with z = w - 2·near, whose far plane is at infinity.
glm::dmat4 withoutFarPlane(const glm::dmat4& clipFromWorld) {
  const glm::dvec4 z = row(clipFromWorld, 2), w = row(clipFromWorld, 3);
  const double slope = glm::dot(glm::dvec3(z), glm::dvec3(w)) / glm::dot(glm::dvec3(w), glm::dvec3(w));
  const double near = (slope * w.w - z.w) / (slope + 1.0);
  glm::dmat4 result = clipFromWorld;
  for (int column = 0; column < 4; ++column) result[column][2] = w[column];
  result[3][2] -= 2.0 * near;
  return result;
}

framegraph::ResourceId findResource(const framegraph::Graph& graph, const std::string& name) {
  for (std::uint32_t i = 0; i < graph.resources().size(); ++i) {
    if (graph.resources()[i].name == name) return {i};
  }
  return {};
}
}  // namespace

Result<ReceiverDepth> declareReceiverDepth(const LightFrame& frame) {
  ReceiverDepth depth;
  depth.clipFromWorld = withoutFarPlane(frame.view.clipFromWorld);
  const glm::dvec4 w = row(frame.view.clipFromWorld, 3);
  depth.farthest = 1e-6;
  for (const DrawItem& item : frame.receivers) {
    for (const glm::dvec3& corner : item.boundsWorld.corners()) {
      depth.farthest = std::max(depth.farthest, glm::dot(w, glm::dvec4(corner, 1.0)) * (1.0 + 1e-6));
    }
  }
  depth.packed = findResource(frame.graph, kName);
  depth.depthTest = findResource(frame.graph, std::string(kName) + " test");
  if (depth.packed.valid()) return depth;

  auto program = frame.programs.get({"receiver_depth.vert", "receiver_depth.frag", {}});
  if (!program) return program.error();
  const int width = frame.view.width, height = frame.view.height;
  depth.packed = frame.graph.addResource({.name = kName, .width = width, .height = height});
  depth.depthTest = frame.graph.addResource({.name = std::string(kName) + " test",
                                             .width = width,
                                             .height = height,
                                             .format = framegraph::Format::depth24,
                                             .storage = framegraph::Storage::renderbuffer});
  framegraph::PassDesc pass{.name = kName, .stage = framegraph::PassStage::receiverPrepass};
  pass.writes = {{.resource = depth.packed, .point = framegraph::AttachmentPoint::color},
                 {.resource = depth.depthTest, .point = framegraph::AttachmentPoint::depth}};
  pass.execute = [program = *program, depth, &view = frame.view,
                  items = std::vector<DrawItem>(frame.receivers.begin(), frame.receivers.end())](
                     framegraph::PassContext& context) {
    gl::Encoder& encoder = context.encoder;
    encoder.useProgram(*program);
    program->set(encoder.context(), "u_inverseFarthest", static_cast<float>(1.0 / depth.farthest));
    gl::DrawState state{.depth = {.test = gl::Compare::less, .write = true}};
    for (const DrawItem& item : items) {
      state.cull = hiddenFaces(item, view.eyeWorld);
      program->set(encoder.context(), "u_clipFromObject",
                   glm::mat4(depth.clipFromWorld * item.worldFromObject));
      item.mesh->draw(encoder, state, GpuMesh::Streams::positions);
    }
  };
  frame.graph.addPass(std::move(pass));
  return depth;
}

ReceiverRays receiverRays(const View& view, const ReceiverDepth& depth, const glm::dmat3& lightFromWorld,
                          const glm::dvec3& lightCenterWorld) {
  // Clip coordinates x, y and w are linear in the position relative to the eye, so that a pixel's ray is the
  // inverse of that map applied to (x, y, 1): its length is 1 along the view axis.
  glm::dmat3 windowFromRay(0.0);
  for (int column = 0; column < 3; ++column) {
    windowFromRay[column] = {view.clipFromWorld[column][0], view.clipFromWorld[column][1],
                             view.clipFromWorld[column][3]};
  }
  const glm::dmat3 ray = lightFromWorld * glm::inverse(windowFromRay) * depth.farthest;
  return {.eye = lightFromWorld * (view.eyeWorld - lightCenterWorld),
          .rayOrigin = ray[2] - ray[0] - ray[1],
          .rayX = ray[0] * (2.0 / view.width),
          .rayY = ray[1] * (2.0 / view.height)};
}

void bindReceiverPosition(framegraph::PassContext& context, gl::Program& program, const ReceiverDepth& depth,
                          const ReceiverRays& rays) {
  gl::Encoder& encoder = context.encoder;
  program.set(encoder.context(), "u_receiverEye", glm::vec4(glm::vec3(rays.eye), 0.0f));
  program.set(encoder.context(), "u_receiverRay", glm::vec4(glm::vec3(rays.rayOrigin), 0.0f));
  program.set(encoder.context(), "u_receiverRayX",
              glm::vec4(glm::vec3(rays.rayX), 1.0f / static_cast<float>(context.viewport.width)));
  program.set(encoder.context(), "u_receiverRayY",
              glm::vec4(glm::vec3(rays.rayY), 1.0f / static_cast<float>(context.viewport.height)));
  const gl::TextureBinding binding{program.samplerUnit("u_receiverDepth"), &context.texture(depth.packed)};
  encoder.bindTextures({&binding, 1});
}

}  // namespace halfshadow::techniques
