// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/occlusion_textures/slice_passes.hpp"

#include <algorithm>
#include <bit>

#include "planner/frame_planner.hpp"
#include "techniques/light_blocks/light_blocks.hpp"

namespace halfshadow::techniques {
namespace {
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
  return planner::combineKeys(seed, std::bit_cast<std::uint64_t>(value));
}

std::uint64_t spaceKey(std::uint64_t seed, const SliceSpace& space) {
  seed = planner::combineKeys(seed, static_cast<std::uint64_t>(space.mapSize));
  seed = keyOf(keyOf(keyOf(seed, space.offsetDistance), space.ratio0), space.sideScale);
  for (const Slice& slice : space.slices) seed = keyOf(keyOf(seed, slice.casterLow), slice.high);
  return seed;
}

void drawCasters(gl::Encoder& encoder, gl::Program& program, const SliceSpace& space, SliceContent content,
                 const std::vector<DrawItem>& items) {
  const bool nearest = content == SliceContent::nearestFaces;
  gl::DrawState state;
  if (nearest) {
    state.depth = {.test = gl::Compare::less, .write = true};
  } else {
    // Ones add up to at least one and are clamped there: whatever the order, the texel is occupied.
    state.blend = {.enabled = true, .source = gl::BlendFactor::one, .destination = gl::BlendFactor::one};
  }
  for (const DrawItem& item : items) {
    if (nearest) {
      // The map looks along +z of a right-handed space, so windings appear turned round.
      const gl::Cull hidden = hiddenFaces(item, space.originWorld);
      state.cull = hidden == gl::Cull::back    ? gl::Cull::front
                   : hidden == gl::Cull::front ? gl::Cull::back
                                               : hidden;
    }
    program.set(encoder.context(), "u_clipFromObject", glm::mat4(space.clipFromWorld * item.worldFromObject));
    item.mesh->draw(encoder, state, GpuMesh::Streams::positions);
  }
}
}  // namespace

Result<SliceTextures> declareSlices(const LightFrame& frame, const SliceSpace& space, SliceContent content,
                                    SliceFilter filter) {
  const bool nearest = content == SliceContent::nearestFaces;
  SliceTextures result{.slicesPerTexture = nearest ? 2 : 4};
  result.contentKey = planner::combineKeys(spaceKey(frame.contentKey, space), nearest ? 2 : 1);
  std::vector<std::string> defines;
  if (nearest) defines.push_back("HS_SLICE_DEPTH");
  auto program = frame.programs.get({"occlusion_slices.vert", "occlusion_slices.frag", defines});
  if (!program) return program.error();
  auto copy = frame.programs.get({"fullscreen.vert", "pyramid_copy.frag", {}});
  if (!copy) return copy.error();

  const std::string prefix = "light " + std::to_string(frame.lightIndex) + " occlusion ";
  for (std::size_t first = 0; first < space.slices.size();
       first += static_cast<std::size_t>(result.slicesPerTexture)) {
    const std::size_t last =
        std::min(first + static_cast<std::size_t>(result.slicesPerTexture), space.slices.size());
    const std::string name = prefix + "slices " + std::to_string(first + 1) + "-" + std::to_string(last);
    const std::uint64_t key = planner::combineKeys(result.contentKey, first + 1);
    const int size = nearest ? 2 * space.mapSize : space.mapSize;
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
    pass.execute = [program = *program, space, content,
                    borders = channelBorders(space, first, result.slicesPerTexture),
                    items = std::vector<DrawItem>(frame.casters.begin(), frame.casters.end())](
                       framegraph::PassContext& context) {
      gl::Encoder& encoder = context.encoder;
      encoder.useProgram(*program);
      program->set(encoder.context(), "u_sliceLow", borders.low);
      program->set(encoder.context(), "u_sliceHigh", borders.high);
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
                                  .contentKey = planner::combineKeys(key, 0xa4e6u),
                                  .sampler = "u_source"});
    }
    result.textures.push_back(averaged);
  }
  return result;
}

}  // namespace halfshadow::techniques
