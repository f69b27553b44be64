// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "planner/frame_planner.hpp"
#include "techniques/light_blocks/light_blocks.hpp"

namespace halfshadow::techniques {
namespace {
/// Where a level lies in the atlas: level 0 at (1, 1), the others stacked to its right, one empty texel
/// around each. blocker_pyramid.glsl computes the same from the level's size.
gl::Rect levelRect(int baseSize, int level) {
  const int side = baseSize >> level;
  if (level == 0) return {1, 1, side, side};
  return {baseSize + 3, 1 + baseSize - 2 * side + 2 * (level - 1), side, side};
}
}  // namespace

Result<BlockerPyramid> declareBlockerPyramid(const LightFrame& frame, const LightDepth& depth) {
  BlockerPyramid pyramid;
  int base = 1;
  while (base * 2 * pyramid.texelsPerBase <= depth.space.mapSize) base *= 2;
  if (base * pyramid.texelsPerBase != depth.space.mapSize || base < 16) {
    return Error{ErrorCode::invalidArgument, "map_size=" + std::to_string(depth.space.mapSize) +
                                                 ": a blocker pyramid needs a power of two of at least 64"};
  }
  pyramid.baseSize = base;
  while ((base >> (pyramid.lastLevel + 1)) >= 2) ++pyramid.lastLevel;

  auto occupancy = frame.programs.get({"fullscreen.vert", "occupancy.frag", depthDefines(depth.storage)});
  if (!occupancy) return occupancy.error();
  auto copy = frame.programs.get({"fullscreen.vert", "pyramid_copy.frag", {}});
  if (!copy) return copy.error();

  const std::string prefix = "light " + std::to_string(frame.lightIndex);
  const auto source = frame.graph.addResource({.name = prefix + " occupancy",
                                               .width = base,
                                               .height = base,
                                               .lifetime = framegraph::Lifetime::persistent,
                                               .filter = framegraph::Filter::linearMipNearest,
                                               .mipmapped = true});
  const MapSpace& space = depth.space;
  const double unit = space.depthUnit;
  const double range = (space.farthestCasterDepth - space.nearestCasterDepth) * unit;
  // Casters end at the far distance; empty texels are at 1. Half-way is as far as possible from both.
  const double empty = 0.5 * (space.farthestCasterDepth + 1.0) * unit;
  const glm::vec4 casterRange(space.nearestCasterDepth * unit, 1.0 / range, empty, 0);
  addFilterPass(frame.graph, {.name = prefix + " occupancy",
                              .program = *occupancy,
                              .source = depth.map,
                              .target = source,
                              .sourceSize = space.mapSize,
                              .contentKey = planner::combineKeys(depth.contentKey, 0x0cc0u),
                              .sampler = "u_depthMap",
                              .setUniforms = [casterRange](gl::Program& program, gl::Context& context) {
                                program.set(context, "u_casterRange", casterRange);
                              }});

  pyramid.atlas = frame.graph.addResource({.name = prefix + " blocker pyramid",
                                           .width = base + base / 2 + 4,
                                           .height = base + 2 * pyramid.lastLevel + 2,
                                           .lifetime = framegraph::Lifetime::persistent,
                                           .filter = framegraph::Filter::linear});
  framegraph::PassDesc pass{
      .name = prefix + " blocker pyramid", .stage = framegraph::PassStage::mask, .reads = {source}};
  pass.writes = {{.resource = pyramid.atlas}};
  pass.contentKey = planner::combineKeys(depth.contentKey, 0xa71a5u);
  pass.execute = [program = *copy, source, base, last = pyramid.lastLevel](framegraph::PassContext& context) {
    gl::Encoder& encoder = context.encoder;
    encoder.useProgram(*program);
    const gl::TextureBinding binding{program->samplerUnit("u_source"), &context.texture(source)};
    encoder.bindTextures({&binding, 1});
    for (int level = 0; level <= last; ++level) {
      encoder.setViewport(levelRect(base, level));
      encoder.drawFullscreen({});
    }
  };
  frame.graph.addPass(std::move(pass));
  return pyramid;
}

void addBlockerPyramid(ReceiverShading& shading, const LightDepth& depth, const BlockerPyramid& pyramid) {
  shading.textures.push_back({.sampler = "u_pyramid", .resource = pyramid.atlas});
  const MapSpace& space = depth.space;
  const float width = static_cast<float>(pyramid.baseSize + pyramid.baseSize / 2 + 4);
  const float height = static_cast<float>(pyramid.baseSize + 2 * pyramid.lastLevel + 2);
  const glm::vec4 layout(pyramid.baseSize, 1.0f / width, 1.0f / height, pyramid.lastLevel);
  const double unit = space.depthUnit;
  const glm::vec4 range(space.nearestCasterDepth * unit,
                        (space.farthestCasterDepth - space.nearestCasterDepth) * unit, pyramid.texelsPerBase,
                        space.farthestCasterDepth * unit);
  shading.setUniforms = [layout, range, inner = std::move(shading.setUniforms)](gl::Program& program,
                                                                                gl::Context& context) {
    inner(program, context);
    program.set(context, "u_pyramidLayout", layout);
    program.set(context, "u_pyramidRange", range);
  };
}

void addSelfReceiverSearch(const LightFrame& frame, const LightDepth& depth, ReceiverShading& shading) {
  shading.defines.push_back("HS_SEARCH 4");
  shading.selfReceivers = ReceiverShading::SelfReceivers::casting;
  const MapSpace& space = depth.space;
  const double texelsPerStep = std::max(space.kernelTexelsPerDepth.x, space.kernelTexelsPerDepth.y) *
                               (space.farthestCasterDepth - space.nearestCasterDepth) / 255.0;
  // The benchmark scenes have at most 3 texels of width a step; a caster a hundred times nearer to the light
  // than the others gives tens, and every penumbra would look hard.
  if (texelsPerStep <= 4.0e9) return;
  shading.selfReceivers = ReceiverShading::SelfReceivers::all;
  frame.graph.noteSkipped(
      "light " + std::to_string(frame.lightIndex) + " blocker means",
      "wide-depth-range: casters are both very near the light and far from it; blockers are "
      "searched by taps");
}

}  // namespace halfshadow::techniques
