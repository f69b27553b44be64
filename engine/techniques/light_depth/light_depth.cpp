// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/light_depth/light_depth.hpp"

#include "planner/frame_planner.hpp"
#include "techniques/light_depth/last_receivers.hpp"

namespace halfshadow::techniques {
namespace {
/// Clip depth over w: behind everything, and not beyond the far plane by rounding.
constexpr double kAlmostInfinite = 1.0 - 1e-6;

using framegraph::Attachment;
using framegraph::AttachmentPoint;
using framegraph::Format;
using framegraph::ResourceDesc;

/// Writes of the depth pass; the last sampled one is the map.
std::vector<Attachment> depthTargets(framegraph::Graph& graph, const std::string& name, int size,
                                     DepthStorage storage, framegraph::Lifetime lifetime, float emptyDepth,
                                     framegraph::ResourceId& map) {
  const bool isTexture = storage == DepthStorage::texture24 || storage == DepthStorage::texture16;
  ResourceDesc desc{.name = name, .width = size, .height = size, .lifetime = lifetime};
  if (isTexture) {
    desc.format = storage == DepthStorage::texture24 ? Format::depth24 : Format::depth16;
    map = graph.addResource(desc);
    return {{.resource = map, .point = AttachmentPoint::depth, .clear = {.depth = emptyDepth}}};
  }
  map = graph.addResource(desc);
  const auto depth = graph.addResource({.name = name + " depth test",
                                        .width = size,
                                        .height = size,
                                        .format = Format::depth24,
                                        .storage = framegraph::Storage::renderbuffer});
  return {{.resource = map,
           .point = AttachmentPoint::color,
           .clear = {.color = {emptyDepth, emptyDepth, emptyDepth, 1}}},
          {.resource = depth, .point = AttachmentPoint::depth, .clear = {.depth = emptyDepth}}};
}

bool keepsFarthest(MapContent content) {
  return content == MapContent::castersFarthest || content == MapContent::lastReceivers;
}

const char* contentName(MapContent content) {
  switch (content) {
    case MapContent::casters:
      return " depth";
    case MapContent::castersFarthest:
      return " farthest depth";
    case MapContent::castersAndReceivers:
      return " depth with receivers";
    case MapContent::lastReceivers:
      return " last receivers' depth";
  }
  return "";
}

/// The part of space before the near distance instead, all of it at depth 0.
MapSpace beforeNear(const MapSpace& space) {
  // A millionth of the near distance is nearer than a fit's own units tell apart; the seam overlaps by a
  // hundredth of the least depth that is kept free of casters.
  constexpr double kFrom = 1e-6, kTo = 1.0 + 1e-5;
  // Clip depth over w is a + b / w: -1 at kFrom, 1 at kTo.
  const double b = -2.0 / (1.0 / kFrom - 1.0 / kTo), a = 1.0 - b / kTo;
  MapSpace before = space;
  for (int column = 0; column < 4; ++column)
    before.mapClipFromWorld[column][2] = a * before.mapClipFromWorld[column][3];
  before.mapClipFromWorld[3][2] += b;
  return before;
}

void drawItems(gl::Encoder& encoder, gl::Program& program, const MapSpace& space, MapContent content,
               std::span<const DrawItem> items, const glm::vec2& depthRange = {0.0f, 1.0f}) {
  const bool farthest = keepsFarthest(content), averted = content == MapContent::castersFarthest;
  gl::DrawState state{.depth = {.test = farthest ? gl::Compare::greater : gl::Compare::less, .write = true},
                      .depthRange = depthRange};
  for (const DrawItem& item : items) {
    // The map looks along +z of a right-handed space, so windings appear turned round.
    const gl::Cull hidden = hiddenFaces(item, space.originWorld);
    const gl::Cull turned = hidden == gl::Cull::back ? gl::Cull::front : gl::Cull::back;
    state.cull = hidden == gl::Cull::none ? hidden : averted ? hidden : turned;
    program.set(encoder.context(), "u_mapClipFromObject",
                glm::mat4(space.mapClipFromWorld * item.worldFromObject));
    item.mesh->draw(encoder, state, GpuMesh::Streams::positions);
  }
}
}  // namespace

Result<LightDepth> declareLightDepth(const LightFrame& frame, MapContent content) {
  LightDepth depth;
  depth.content = content;
  depth.storage = depthStorageFor(frame.capabilities);
  depth.space = makeMapSpace(frame.fit, depth.storage);
  const bool all = content == MapContent::castersAndReceivers;
  const bool last = content == MapContent::lastReceivers;
  const bool keyed = frame.mapLifetime == framegraph::Lifetime::persistent;
  depth.contentKey = !keyed ? 0
                            : planner::combineKeys(all ? frame.sceneKey : frame.contentKey,
                                                   static_cast<std::uint64_t>(depth.storage) * 4 +
                                                       static_cast<std::uint64_t>(content));
  LastReceivers receivers;
  if (last) {
    receivers = lastReceivers(frame);
    depth.contentKey = planner::combineKeys(depth.contentKey, receivers.contentKey);
  }
  const std::string name = "light " + std::to_string(frame.lightIndex) + contentName(content) + frame.mapName;

  const gl::Texture* ramp = nullptr;
  if (depth.storage == DepthStorage::packed16) {
    auto made = frame.shared.byteRamp(frame.context);
    if (!made) return made.error();
    ramp = *made;
  }
  auto program = frame.programs.get({"light_depth.vert", "light_depth.frag", depthDefines(depth.storage)});
  if (!program) return program.error();

  framegraph::PassDesc pass{.name = name, .stage = framegraph::PassStage::light};
  pass.writes = depthTargets(frame.graph, name, frame.fit.mapSize, depth.storage, frame.mapLifetime,
                             keepsFarthest(content) ? 0.0f : 1.0f, depth.map);
  pass.contentKey = depth.contentKey;
  std::vector<DrawItem> items =
      last ? std::move(receivers.drawn) : std::vector<DrawItem>(frame.casters.begin(), frame.casters.end());
  if (all) items.insert(items.end(), frame.shadowlessReceivers.begin(), frame.shadowlessReceivers.end());
  // What is farthest is never before the near distance.
  const bool before = frame.fit.castersBeforeNear && !keepsFarthest(content);
  pass.execute = [program = *program, ramp, space = depth.space, content, before, items = std::move(items),
                  infinite = std::move(receivers.infinite)](framegraph::PassContext& context) {
    gl::Encoder& encoder = context.encoder;
    encoder.useProgram(*program);
    program->set(encoder.context(), "u_depthOfDistance", glm::vec2(1.0f, 1.0f));
    if (ramp) {
      const gl::TextureBinding binding{program->samplerUnit("u_byteRamp"), ramp};
      encoder.bindTextures({&binding, 1});
    }
    drawItems(encoder, *program, space, content, items);
    if (before) {
      program->set(encoder.context(), "u_depthOfDistance", glm::vec2(0.0f));
      drawItems(encoder, *program, beforeNear(space), content, items, glm::vec2(0.0f));
    }
    if (infinite.empty()) return;
    MapSpace flat = space;
    for (int column = 0; column < 4; ++column)
      flat.mapClipFromWorld[column][2] = kAlmostInfinite * flat.mapClipFromWorld[column][3];
    // The ramp repeats at depth 1.
    program->set(encoder.context(), "u_depthOfDistance", glm::vec2(1.0f, 1e-3f));
    drawItems(encoder, *program, flat, content, infinite);
  };
  frame.graph.addPass(std::move(pass));
  return depth;
}

ReceiverShading mapReceiverShading(const LightFrame& frame, const LightDepth& depth,
                                   std::string fragmentFile) {
  ReceiverShading shading;
  shading.fragmentFile = std::move(fragmentFile);
  shading.defines = depthDefines(depth.storage);
  // The border of a map of casters is empty, so that clamped taps outside are lit; receivers fill the border.
  if (depth.content == MapContent::castersAndReceivers) shading.defines.push_back("HS_LIT_OUTSIDE");
  shading.mapFromWorld = depth.space.mapFromWorld;
  shading.usesFacetPlane = true;
  shading.textures = {{.sampler = "u_depthMap", .resource = depth.map}};
  if (depth.storage == DepthStorage::packed16) {
    if (auto ramp = frame.shared.byteRamp(frame.context))
      shading.textures.push_back({.sampler = "u_byteRamp", .texture = *ramp});
  }
  const MapSpace& space = depth.space;
  const double knob = frame.settings.real("bias");
  // Without highp the map position itself is off by up to one texel, so every tap counts as "anywhere".
  const double positionError = depth.storage == DepthStorage::packed16 ? 1.0 : 0.0;
  const double size = space.mapSize;
  // A quarter of the range per texel: the light grazes the facet, whose own shading is then dark anyway.
  const double largestGradient = 0.25 * space.depthUnit;
  const glm::vec4 map(size, 1.0 / size, space.depthUnit, largestGradient);
  const glm::vec4 bias(knob * space.quantum * space.depthUnit, knob * (0.1 + positionError),
                       knob * (0.6 + positionError), 0.0);
  const glm::vec4 plane(space.depthUnit, size, size, largestGradient);
  shading.setUniforms = [map, bias, plane](gl::Program& program, gl::Context& context) {
    program.set(context, "u_map", map);
    program.set(context, "u_bias", bias);
    program.set(context, "u_vertexPlane", plane);
  };
  return shading;
}

}  // namespace halfshadow::techniques
