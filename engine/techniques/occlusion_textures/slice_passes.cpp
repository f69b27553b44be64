// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/occlusion_textures/slice_passes.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "base/keys.hpp"
#include "techniques/parts/maps/last_receivers.hpp"
#include "techniques/parts/maps/light_blocks.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::ResourceId;

/// Clip depth over w: behind everything, and not beyond the far plane by rounding.
constexpr double kAlmostInfinite = 1.0 - 1e-6;

/// Borders of the slices in a texture's channels; a channel without slice has an empty interval.
struct ChannelBorders {
  glm::vec4 low{2.0f}, high{-1.0f};
};

ChannelBorders channelBorders(const SliceSpace& space, std::size_t firstSlice, int count) {
  ChannelBorders borders;
  for (int channel = 0; channel < count && firstSlice + channel < space.slices.size(); ++channel) {
    borders.low[channel] = static_cast<float>(space.slices[firstSlice + channel].casterLow);
    borders.high[channel] = static_cast<float>(space.slices[firstSlice + channel].high);
  }
  return borders;
}

std::uint64_t keyOf(std::uint64_t seed, double value) {
  return combineKeys(seed, std::bit_cast<std::uint64_t>(value));
}

std::uint64_t spaceKey(std::uint64_t seed, const SliceSpace& space) {
  seed = combineKeys(seed, static_cast<std::uint64_t>(space.mapSize));
  seed = keyOf(keyOf(keyOf(seed, space.offsetDistance), space.ratio0), space.sideScale);
  seed = keyOf(seed, space.depthSlices);
  for (const Slice& slice : space.slices) seed = keyOf(keyOf(seed, slice.casterLow), slice.high);
  return seed;
}

/// Faces that look towards the light, the nearest or the farthest.
void drawFacing(gl::Encoder& encoder, gl::Program& program, const glm::dmat4& clipFromWorld,
                const glm::dvec3& originWorld, gl::Compare order, const std::vector<DrawItem>& items) {
  gl::DrawState state{.depth = {.test = order, .write = true}};
  for (const DrawItem& item : items) {
    // The map looks along +z of a right-handed space, so windings appear turned round.
    const gl::Cull hidden = hiddenFaces(item, originWorld);
    state.cull = hidden == gl::Cull::back    ? gl::Cull::front
                 : hidden == gl::Cull::front ? gl::Cull::back
                                             : hidden;
    program.set(encoder.context(), "u_clipFromObject", glm::mat4(clipFromWorld * item.worldFromObject));
    item.mesh->draw(encoder, state, GpuMesh::Streams::positions);
  }
}

void drawCasters(gl::Encoder& encoder, gl::Program& program, const SliceSpace& space, SliceContent content,
                 const std::vector<DrawItem>& items) {
  if (content == SliceContent::nearestFaces) {
    drawFacing(encoder, program, space.clipFromWorld, space.originWorld, gl::Compare::less, items);
    return;
  }
  gl::DrawState state;
  // Ones add up to at least one and are clamped there: whatever the order, the texel is occupied.
  state.blend = {.enabled = true, .source = gl::BlendFactor::one, .destination = gl::BlendFactor::one};
  for (const DrawItem& item : items) {
    program.set(encoder.context(), "u_clipFromObject", glm::mat4(space.clipFromWorld * item.worldFromObject));
    item.mesh->draw(encoder, state, GpuMesh::Streams::positions);
  }
}

/// Of slice passes: slice units of depth 1, 1 / texels per side, and the least depth from a caster to what it
/// shadows: two steps of the stored depth.
glm::vec4 depthUniform(const SliceSpace& space, int size) {
  return {space.depthSlices, 1.0 / size, 2.0 / 16777215.0, 0};
}

struct LastReceiverDepth {
  ResourceId map;
  std::uint64_t contentKey = 0;
};
/// Depth of the last receivers as the slicing passes see them, 24 bits packed.
Result<std::optional<LastReceiverDepth>> declareLastReceivers(const LightFrame& frame,
                                                              const SliceSpace& space, int size) {
  // Without highp no comparison tells a ground from what lies on it.
  if (!frame.capabilities.has(device::Capability::highp)) return std::optional<LastReceiverDepth>();
  LastReceivers last = lastReceivers(frame);
  if (last.empty) return std::optional<LastReceiverDepth>();
  auto program = frame.programs.get(
      {"occlusion/occlusion_slices.vert", "occlusion/occlusion_slices.frag", {"HS_PACK_DEPTH"}});
  if (!program) return program.error();
  const std::string name = "light " + std::to_string(frame.lightIndex) + " occlusion last receivers";
  LastReceiverDepth result{.contentKey = combineKeys(spaceKey(last.contentKey, space), 3)};
  result.map = frame.graph.addResource(
      {.name = name, .width = size, .height = size, .lifetime = framegraph::Lifetime::persistent});
  const auto depth = frame.graph.addResource({.name = name + " depth test",
                                              .width = size,
                                              .height = size,
                                              .format = framegraph::Format::depth24,
                                              .storage = framegraph::Storage::renderbuffer});
  framegraph::PassDesc pass{.name = name, .stage = framegraph::PassStage::light};
  pass.writes = {{.resource = result.map, .point = framegraph::AttachmentPoint::color},
                 {.resource = depth, .point = framegraph::AttachmentPoint::depth, .clear = {.depth = 0.0f}}};
  pass.contentKey = result.contentKey;
  pass.execute = [program = *program, space, drawn = std::move(last.drawn),
                  infinite = std::move(last.infinite)](framegraph::PassContext& context) {
    gl::Encoder& encoder = context.encoder;
    encoder.useProgram(*program);
    drawFacing(encoder, *program, space.clipFromWorld, space.originWorld, gl::Compare::greater, drawn);
    glm::dmat4 flat = space.clipFromWorld;
    for (int column = 0; column < 4; ++column) flat[column][2] = kAlmostInfinite * flat[column][3];
    drawFacing(encoder, *program, flat, space.originWorld, gl::Compare::greater, infinite);
  };
  frame.graph.addPass(std::move(pass));
  return std::optional<LastReceiverDepth>(result);
}
}  // namespace

Result<SliceTextures> declareSlices(const LightFrame& frame, const SliceSpace& space, SliceContent content,
                                    SliceFilter filter) {
  const bool nearest = content == SliceContent::nearestFaces;
  SliceTextures result{.slicesPerTexture = nearest ? 2 : 4};
  result.contentKey = combineKeys(spaceKey(frame.contentKey, space), nearest ? 2 : 1);
  const int size = nearest ? 2 * space.mapSize : space.mapSize;
  std::vector<std::string> defines;
  std::optional<LastReceiverDepth> last;
  if (nearest) {
    defines.push_back("HS_SLICE_DEPTH");
    auto declared = declareLastReceivers(frame, space, size);
    if (!declared) return declared.error();
    last = *declared;
    if (last) {
      defines.push_back("HS_LAST_RECEIVERS");
      result.lastReceivers = last->map;
      result.contentKey = combineKeys(result.contentKey, last->contentKey);
    }
  }
  auto program =
      frame.programs.get({"occlusion/occlusion_slices.vert", "occlusion/occlusion_slices.frag", defines});
  if (!program) return program.error();
  auto copy = frame.programs.get({"screen/fullscreen.vert", "map/pyramid_copy.frag", {}});
  if (!copy) return copy.error();

  const std::string prefix = "light " + std::to_string(frame.lightIndex) + " occlusion ";
  for (std::size_t first = 0; first < space.slices.size();
       first += static_cast<std::size_t>(result.slicesPerTexture)) {
    const std::size_t end =
        std::min(first + static_cast<std::size_t>(result.slicesPerTexture), space.slices.size());
    const std::string name = prefix + "slices " + std::to_string(first + 1) + "-" + std::to_string(end);
    const std::uint64_t key = combineKeys(result.contentKey, first + 1);
    framegraph::ResourceDesc desc{.name = name,
                                  .width = space.mapSize,
                                  .height = space.mapSize,
                                  .lifetime = framegraph::Lifetime::persistent};
    if (filter == SliceFilter::mipmap) {
      desc.mipmapped = true;
      desc.filter = framegraph::Filter::linearMipNearest;
    }
    const auto averaged = frame.graph.addResource(desc);
    auto target = averaged;
    if (nearest) {
      target = frame.graph.addResource({.name = name + ", fine",
                                        .width = size,
                                        .height = size,
                                        .lifetime = framegraph::Lifetime::persistent,
                                        .filter = framegraph::Filter::linear});
    }
    framegraph::PassDesc pass{.name = frame.graph.resources()[target.index].name,
                              .stage = framegraph::PassStage::light};
    pass.writes = {{.resource = target, .point = framegraph::AttachmentPoint::color}};
    if (nearest) {
      const auto depth = frame.graph.addResource({.name = name + " depth test",
                                                  .width = size,
                                                  .height = size,
                                                  .format = framegraph::Format::depth24,
                                                  .storage = framegraph::Storage::renderbuffer});
      pass.writes.push_back({.resource = depth, .point = framegraph::AttachmentPoint::depth});
    }
    pass.contentKey = key;
    if (last) pass.reads = {last->map};
    pass.execute = [program = *program, space, content, last, depth = depthUniform(space, size),
                    borders = channelBorders(space, first, result.slicesPerTexture),
                    items = std::vector<DrawItem>(frame.casters.begin(), frame.casters.end())](
                       framegraph::PassContext& context) {
      gl::Encoder& encoder = context.encoder;
      encoder.useProgram(*program);
      program->set(encoder.context(), "u_sliceLow", borders.low);
      program->set(encoder.context(), "u_sliceHigh", borders.high);
      program->set(encoder.context(), "u_sliceDepth", depth);
      if (last) {
        const gl::TextureBinding binding{program->samplerUnit("u_lastReceivers"),
                                         &context.texture(last->map)};
        encoder.bindTextures({&binding, 1});
      }
      drawCasters(encoder, *program, space, content, items);
    };
    frame.graph.addPass(std::move(pass));
    if (nearest) {
      // A linear fetch at a corner of four fine texels is their mean.
      addFilterPass(frame.graph, {.name = name,
                                  .program = *copy,
                                  .source = target,
                                  .target = averaged,
                                  .sourceSize = size,
                                  .contentKey = combineKeys(key, 0xa4e6u),
                                  .sampler = "u_source"});
    }
    result.textures.push_back(averaged);
  }
  return result;
}

}  // namespace halfshadow::techniques
