// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/occlusion_textures/slice_passes.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "base/keys.hpp"
#include "techniques/parts/maps/filter_pass.hpp"
#include "techniques/parts/maps/last_receivers.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::ResourceId;

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
  seed = combineKeys(seed, static_cast<std::uint64_t>(space.mapSize.x * 65536 + space.mapSize.y));
  seed = keyOf(keyOf(keyOf(seed, space.offsetDistance), space.ratio0), space.sideScale);
  seed = keyOf(seed, space.depthSlices);
  seed = combineKeys(seed, static_cast<std::uint64_t>(space.grid.alongU * 16 + space.grid.alongV));
  for (const Slice& slice : space.slices) seed = keyOf(keyOf(seed, slice.casterLow), slice.high);
  return seed;
}

/// The faces that the centre of projection sees.
MeshDraw facing(const SliceView& view, std::span<const DrawItem> items) {
  return {.items = items,
          .clipFromWorld = view.clipFromWorld,
          .faces = MeshDraw::Faces::turned,
          .eyeWorld = view.originWorld};
}

/// `draw` for each view, into its part of an atlas; `meshes` says what of it is drawn.
template <typename Meshes>
void addToTiles(PlannedPass& pass, const SliceSpace& space, int scale, PlannedDraw draw, Meshes meshes) {
  for (std::size_t i = 0; i < space.views.size(); ++i) {
    draw.what = meshes(space.views[i]);
    draw.viewport = space.tile(i, scale);
    pass.draws.push_back(draw);
  }
}

void addCasters(PlannedPass& pass, const SliceSpace& space, SliceContent content, int scale, PlannedDraw draw,
                std::span<const DrawItem> items) {
  const bool nearest = content == SliceContent::nearestFaces;
  if (nearest) {
    draw.state.depth = {.test = device::Compare::less, .write = true};
  } else {
    // Ones add up to at least one and are clamped there: whatever the order, the texel is occupied.
    draw.state.blend = {
        .enabled = true, .source = device::BlendFactor::one, .destination = device::BlendFactor::one};
  }
  addToTiles(pass, space, scale, std::move(draw), [&](const SliceView& view) {
    MeshDraw meshes = facing(view, items);
    if (!nearest) meshes.faces = MeshDraw::Faces::all;
    return meshes;
  });
}

/// Of slice passes: slice units of depth 1, 1 / texels of the atlas per side, and the least depth from a
/// caster to what it shadows: two steps of the stored depth.
glm::vec4 depthUniform(const SliceSpace& space, int size) {
  return {space.depthSlices, 1.0 / size, 2.0 / 16777215.0, 0};
}

struct LastReceiverDepth {
  ResourceId map;
  std::uint64_t contentKey = 0;
};
std::optional<LastReceiverDepth> planLastReceivers(const LightScene& scene, PassPlan& plan,
                                                   const SliceSpace& space, int scale) {
  // Without highp no comparison tells a ground from what lies on it.
  if (!scene.capabilities.has(device::Capability::highp)) return std::nullopt;
  LastReceivers last = lastReceivers(scene);
  if (last.empty) return std::nullopt;
  const int size = scale * space.atlasSize;
  const std::string name = scene.name + " occlusion last receivers";
  LastReceiverDepth result{.contentKey = combineKeys(spaceKey(last.contentKey, space), 3)};
  result.map = plan.addImage(
      {.name = name, .width = size, .height = size, .lifetime = framegraph::Lifetime::persistent});
  const auto depth = plan.addImage({.name = name + " depth test",
                                    .width = size,
                                    .height = size,
                                    .format = framegraph::Format::depth24,
                                    .storage = framegraph::Storage::renderbuffer});
  PlannedPass pass{.name = name, .stage = framegraph::PassStage::light, .contentKey = result.contentKey};
  pass.writes = {{.resource = result.map, .point = framegraph::AttachmentPoint::color},
                 {.resource = depth, .point = framegraph::AttachmentPoint::depth, .clear = {.depth = 0.0f}}};
  PlannedDraw draw{
      .program = plan.addProgram(
          {"occlusion/occlusion_slices.vert", "occlusion/occlusion_slices.frag", {"HS_PACK_DEPTH"}})};
  draw.state.depth = {.test = device::Compare::greater, .write = true};
  const auto drawn = plan.keep(std::move(last.drawn)), infinite = plan.keep(std::move(last.infinite));
  addToTiles(pass, space, scale, draw, [&](const SliceView& view) { return facing(view, drawn); });
  addToTiles(pass, space, scale, draw, [&](SliceView view) {
    view.clipFromWorld = almostInfinitelyFar(view.clipFromWorld);
    return facing(view, infinite);
  });
  plan.passes.push_back(std::move(pass));
  return result;
}
framegraph::ResourceDesc texturesDesc(const std::string& name, const SliceSpace& space, SliceFilter filter) {
  framegraph::ResourceDesc desc{.name = name,
                                .width = space.atlasSize,
                                .height = space.atlasSize,
                                .lifetime = framegraph::Lifetime::persistent};
  if (filter == SliceFilter::mipmap) {
    desc.mipmapped = true;
    desc.filter = framegraph::Filter::linearMipNearest;
  }
  return desc;
}

/// Texels of a map a side that one of several views' maps is drawn with. Casters are drawn once for each view
/// instead of once for each texture.
constexpr int kSorted = 3;

/// Nearest faces of all views in one pass, sorted into slices by one for each texture.
SliceTextures planSortedSlices(const LightScene& scene, PassPlan& plan, const SliceSpace& space,
                               SliceFilter filter) {
  SliceTextures result{.slicesPerTexture = 2};
  result.contentKey = combineKeys(spaceKey(scene.contentKey, space), 3);
  const int size = kSorted * space.atlasSize;
  const std::optional<LastReceiverDepth> last = planLastReceivers(scene, plan, space, kSorted);
  std::vector<std::string> defines;
  if (last) {
    defines.push_back("HS_LAST_RECEIVERS");
    result.lastReceivers = last->map;
    result.contentKey = combineKeys(result.contentKey, last->contentKey);
  }
  const std::string name = scene.name + " occlusion casters";
  const auto fine = plan.addImage(
      {.name = name, .width = size, .height = size, .lifetime = framegraph::Lifetime::persistent});
  const auto depth = plan.addImage({.name = name + " depth test",
                                    .width = size,
                                    .height = size,
                                    .format = framegraph::Format::depth24,
                                    .storage = framegraph::Storage::renderbuffer});
  PlannedPass pass{.name = name,
                   .stage = framegraph::PassStage::light,
                   .contentKey = combineKeys(spaceKey(scene.contentKey, space), 4)};
  pass.writes = {
      {.resource = fine, .point = framegraph::AttachmentPoint::color, .clear = {.color = {1, 1, 1, 1}}},
      {.resource = depth, .point = framegraph::AttachmentPoint::depth}};
  PlannedDraw draw{
      .program = plan.addProgram(
          {"occlusion/occlusion_slices.vert", "occlusion/occlusion_slices.frag", {"HS_PACK_DEPTH"}})};
  addCasters(pass, space, SliceContent::nearestFaces, kSorted, std::move(draw), scene.casters);
  plan.passes.push_back(std::move(pass));
  for (std::size_t first = 0; first < space.slices.size(); first += 2) {
    const std::string slices = scene.name + " occlusion slices " + std::to_string(first + 1) + "-" +
                               std::to_string(std::min(first + 2, space.slices.size()));
    const ChannelBorders borders = channelBorders(space, first, 2);
    device::UniformList uniforms;
    uniforms.set("u_sliceLow", borders.low);
    uniforms.set("u_sliceHigh", borders.high);
    uniforms.set("u_sliceDepth", depthUniform(space, size));
    const auto target = plan.addImage(texturesDesc(slices, space, filter));
    addFilterPass(plan, {.name = slices,
                         .fragmentFile = "occlusion/occlusion_sort.frag",
                         .defines = defines,
                         .source = fine,
                         .target = target,
                         .sourceSize = size,
                         .targetSize = space.atlasSize,
                         .contentKey = combineKeys(result.contentKey, first + 1),
                         .sampler = "u_source",
                         .uniforms = std::move(uniforms)});
    if (last) {
      plan.passes.back().draws.back().textures.push_back(
          {.sampler = "u_lastReceivers", .resource = last->map});
    }
    result.textures.push_back(target);
  }
  return result;
}
}  // namespace

SliceTextures planSlices(const LightScene& scene, PassPlan& plan, const SliceSpace& space,
                         SliceContent content, SliceFilter filter) {
  const bool nearest = content == SliceContent::nearestFaces;
  // Without highp no shader takes packed depths apart.
  if (nearest && !space.grid.whole() && scene.capabilities.has(device::Capability::highp))
    return planSortedSlices(scene, plan, space, filter);
  SliceTextures result{.slicesPerTexture = nearest ? 2 : 4};
  result.contentKey = combineKeys(spaceKey(scene.contentKey, space), nearest ? 2 : 1);
  const int scale = nearest ? 2 : 1;
  const int size = scale * space.atlasSize;
  std::vector<std::string> defines;
  std::optional<LastReceiverDepth> last;
  if (nearest) {
    defines.push_back("HS_SLICE_DEPTH");
    last = planLastReceivers(scene, plan, space, scale);
    if (last) {
      defines.push_back("HS_LAST_RECEIVERS");
      result.lastReceivers = last->map;
      result.contentKey = combineKeys(result.contentKey, last->contentKey);
    }
  }
  const std::string prefix = scene.name + " occlusion ";
  for (std::size_t first = 0; first < space.slices.size();
       first += static_cast<std::size_t>(result.slicesPerTexture)) {
    const std::size_t end =
        std::min(first + static_cast<std::size_t>(result.slicesPerTexture), space.slices.size());
    const std::string name = prefix + "slices " + std::to_string(first + 1) + "-" + std::to_string(end);
    const std::uint64_t key = combineKeys(result.contentKey, first + 1);
    const auto averaged = plan.addImage(texturesDesc(name, space, filter));
    auto target = averaged;
    if (nearest) {
      target = plan.addImage({.name = name + ", fine",
                              .width = size,
                              .height = size,
                              .lifetime = framegraph::Lifetime::persistent,
                              .filter = framegraph::Filter::linear});
    }
    PlannedPass pass{.name = plan.images[target.index].name, .stage = framegraph::PassStage::light};
    pass.writes = {{.resource = target, .point = framegraph::AttachmentPoint::color}};
    if (nearest) {
      const auto depth = plan.addImage({.name = name + " depth test",
                                        .width = size,
                                        .height = size,
                                        .format = framegraph::Format::depth24,
                                        .storage = framegraph::Storage::renderbuffer});
      pass.writes.push_back({.resource = depth, .point = framegraph::AttachmentPoint::depth});
    }
    pass.contentKey = key;
    PlannedDraw draw{.program = plan.addProgram(
                         {"occlusion/occlusion_slices.vert", "occlusion/occlusion_slices.frag", defines})};
    const ChannelBorders borders = channelBorders(space, first, result.slicesPerTexture);
    draw.uniforms.set("u_sliceLow", borders.low);
    draw.uniforms.set("u_sliceHigh", borders.high);
    draw.uniforms.set("u_sliceDepth", depthUniform(space, size));
    if (last) draw.textures = {{.sampler = "u_lastReceivers", .resource = last->map}};
    addCasters(pass, space, content, scale, std::move(draw), scene.casters);
    plan.passes.push_back(std::move(pass));
    if (nearest) {
      // A linear fetch at a corner of four fine texels is their mean.
      addFilterPass(plan, {.name = name,
                           .fragmentFile = "map/pyramid_copy.frag",
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
