// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <array>
#include <cmath>

#include "planner/frame_planner.hpp"
#include "techniques/light_blocks/light_blocks.hpp"

namespace halfshadow::techniques {
namespace {
/// Texels of blocks that the two source images hold, in texels of the one before.
constexpr int kReduction = 8;
/// Blocks per side of the finest level at most: finer ones bound no penumbra more tightly that is wide enough
/// to need a filter.
constexpr int kMostBlocks = 128;

/// Where a level lies in the atlas, as penumbra_bounds.glsl finds it: the finest at the left, the others
/// stacked at its right.
gl::Rect levelRect(int blocks, int level) {
  const int side = blocks >> level;
  if (level == 0) return {0, 0, side, side};
  return {blocks, blocks - 2 * side, side, side};
}

struct LevelDraw {
  gl::Program* program = nullptr;
  framegraph::ResourceId source;
  int sourceSize = 0;
  gl::Rect rect;
};
}  // namespace

Result<PenumbraBounds> declarePenumbraBounds(const LightFrame& frame, const LightDepth& depth) {
  PenumbraBounds bounds;
  const int mapSize = depth.space.mapSize;
  // Two blocks a side at least: then 3 x 3 blocks of the coarsest level are the whole map.
  while (bounds.blockTexels * kMostBlocks < mapSize) bounds.blockTexels *= 2;
  while (bounds.blocks * bounds.blockTexels < mapSize) bounds.blocks *= 2;
  while ((bounds.blocks >> (bounds.lastLevel + 1)) >= 2) ++bounds.lastLevel;

  const std::string prefix = "light " + std::to_string(frame.lightIndex) + " penumbra bounds ";
  framegraph::ResourceId source = depth.map;
  int sourceSize = mapSize, factor = bounds.blockTexels;
  std::vector<std::pair<framegraph::ResourceId, int>> images;
  // Blocks of the finest level, then, where there are many, blocks of eight times their side.
  for (int size = bounds.blocks; size >= 2 && images.size() < 2; size /= kReduction) {
    auto defines = depthDefines(depth.storage);
    defines.push_back("HS_FACTOR " + std::to_string(factor));
    if (images.empty()) defines.push_back("HS_FROM_DEPTH");
    auto program = frame.programs.get({"fullscreen.vert", "block_bounds.frag", defines});
    if (!program) return program.error();
    const std::string name = prefix + std::to_string(size);
    const auto target = frame.graph.addResource(
        {.name = name, .width = size, .height = size, .lifetime = framegraph::Lifetime::persistent});
    addFilterPass(frame.graph, {.name = name,
                                .program = *program,
                                .source = source,
                                .target = target,
                                .sourceSize = sourceSize,
                                .targetSize = size,
                                .contentKey = planner::combineKeys(depth.contentKey,
                                                                   static_cast<std::uint64_t>(size)),
                                .sampler = "u_source"});
    images.emplace_back(target, size);
    source = target;
    sourceSize = size;
    factor = kReduction;
  }

  bounds.atlas = frame.graph.addResource({.name = prefix + "levels",
                                          .width = bounds.blocks + bounds.blocks / 2,
                                          .height = bounds.blocks,
                                          .lifetime = framegraph::Lifetime::persistent});
  std::vector<LevelDraw> draws;
  framegraph::PassDesc pass{.name = prefix + "levels", .stage = framegraph::PassStage::mask};
  for (int level = 0; level <= bounds.lastLevel; ++level) {
    const int side = bounds.blocks >> level;
    const auto& image = images.size() > 1 && images[1].second >= side ? images[1] : images[0];
    auto program = frame.programs.get(
        {"fullscreen.vert", "block_dilate.frag", dilationDefines(1, std::max(image.second / side, 1))});
    if (!program) return program.error();
    draws.push_back({*program, image.first, image.second, levelRect(bounds.blocks, level)});
  }
  for (const auto& image : images) pass.reads.push_back(image.first);
  pass.writes = {{.resource = bounds.atlas, .initial = framegraph::InitialContent::dontCare}};
  pass.contentKey = planner::combineKeys(depth.contentKey, 0xb0bdu);
  pass.execute = [draws = std::move(draws)](framegraph::PassContext& context) {
    gl::Encoder& encoder = context.encoder;
    for (const LevelDraw& draw : draws) {
      encoder.useProgram(*draw.program);
      const float size = static_cast<float>(draw.sourceSize);
      draw.program->set(encoder.context(), "u_sourceSize", glm::vec4(size, 1.0f / size, 0, 0));
      const gl::TextureBinding binding{draw.program->samplerUnit("u_source"), &context.texture(draw.source)};
      encoder.bindTextures({&binding, 1});
      encoder.setViewport(draw.rect);
      encoder.drawFullscreen({});
    }
  };
  frame.graph.addPass(std::move(pass));
  return bounds;
}

Status addPenumbraBounds(const LightFrame& frame, const LightDepth& depth, ReceiverShading& shading) {
  auto bounds = declarePenumbraBounds(frame, depth);
  if (!bounds) return bounds.error();
  shading.textures.push_back({.sampler = "u_blockMap", .resource = bounds->atlas});
  const MapSpace& space = depth.space;
  // Half of the narrowest kernel and half a texel to its tap's centre; without highp a fragment's own place
  // is off by up to a texel.
  const double slack = depth.storage == DepthStorage::packed16 ? 2.0 : 1.0;
  const glm::vec4 uniform(bounds->blocks, 1.0 / (bounds->blockTexels * bounds->blocks), bounds->lastLevel,
                          slack);
  const glm::vec4 penumbra(space.kernelTexelsPerDepth / space.depthUnit,
                           space.nearestCasterDepth * space.depthUnit, 0.0);
  shading.setUniforms = [uniform, penumbra, inner = std::move(shading.setUniforms)](gl::Program& program,
                                                                                    gl::Context& context) {
    inner(program, context);
    program.set(context, "u_bounds", uniform);
    program.set(context, "u_penumbra", penumbra);
  };
  shading.skip = frame.preferredSkip == FilterSkip::stencil ? FilterSkip::stencil : FilterSkip::branch;
  return {};
}

double widestPenumbraTexels(const LightFrame& frame, const MapSpace& space) {
  const double farthest =
      1.0 - space.nearDistance / std::max(frame.receiverFarDistance, frame.fit.farDistance);
  return std::max(space.kernelTexelsPerDepth.x, space.kernelTexelsPerDepth.y) *
         (farthest - space.nearestCasterDepth);
}

}  // namespace halfshadow::techniques
