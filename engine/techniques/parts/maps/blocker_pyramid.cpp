// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "base/keys.hpp"
#include "techniques/parts/maps/level_atlas.hpp"

namespace halfshadow::techniques {
namespace {
/// Cells of the second source image are this much larger.
constexpr int kReduction = 8;
}  // namespace

Result<BlockerPyramid> declareBlockerPyramid(const LightFrame& frame, const LightDepth& depth) {
  BlockerPyramid pyramid;
  LevelAtlas atlas;
  while (atlas.finestSide * 2 * pyramid.texelsPerCell <= depth.space.mapSize) atlas.finestSide *= 2;
  if (atlas.finestSide * pyramid.texelsPerCell != depth.space.mapSize || atlas.finestSide < 16) {
    return Error{ErrorCode::invalidArgument, "map_size=" + std::to_string(depth.space.mapSize) +
                                                 ": a blocker pyramid needs a power of two of at least 64"};
  }
  while (atlas.side(atlas.lastLevel) > 2) ++atlas.lastLevel;
  pyramid.cells = atlas.finestSide;
  pyramid.lastLevel = atlas.lastLevel;

  auto occupancy =
      frame.programs.get({"screen/fullscreen.vert", "map/occupancy.frag", depthDefines(depth.storage)});
  if (!occupancy) return occupancy.error();
  const auto reduction = [&](int factor) {
    return frame.programs.get(
        {"screen/fullscreen.vert", "map/occupancy_level.frag", {"HS_CELL " + std::to_string(factor)}});
  };
  const std::string prefix = "light " + std::to_string(frame.lightIndex) + " blockers";
  const auto persistent = [&](const std::string& name, int width, int height) {
    return frame.graph.addResource(
        {.name = name, .width = width, .height = height, .lifetime = framegraph::Lifetime::persistent});
  };
  const MapSpace& space = depth.space;
  const double unit = space.depthUnit;
  const double range = (space.farthestCasterDepth - space.nearestCasterDepth) * unit;
  // Casters end at the far distance; empty texels are at 1. Half-way is as far as possible from both.
  const double empty = 0.5 * (space.farthestCasterDepth + 1.0) * unit;
  const glm::vec4 casterRange(space.nearestCasterDepth * unit, 1.0 / range, empty, 0);
  const int side = atlas.finestSide;
  std::vector<LevelImage> images;
  images.push_back(
      {persistent(prefix + " " + std::to_string(side), side, side), side, side, {0, 0, side, side}});
  addFilterPass(frame.graph, {.name = prefix + " " + std::to_string(side),
                              .program = *occupancy,
                              .source = depth.map,
                              .target = images.front().image,
                              .sourceSize = space.mapSize,
                              .contentKey = combineKeys(depth.contentKey, 0x0cc0u),
                              .sampler = "u_depthMap",
                              .setUniforms = [casterRange](gl::Program& program, gl::Context& context) {
                                program.set(context, "u_casterRange", casterRange);
                              }});
  if (side / kReduction >= 2) {
    // What coarse levels are made of, so that no texel reads hundreds.
    auto program = reduction(kReduction);
    if (!program) return program.error();
    const int small = side / kReduction;
    images.push_back(
        {persistent(prefix + " " + std::to_string(small), small, small), small, small, {0, 0, small, small}});
    addLevelPass(frame.graph, prefix + " " + std::to_string(small), images.back().image,
                 {{*program, images.front(), images.back().rect}}, combineKeys(depth.contentKey, 0x0cc1u));
  }
  pyramid.atlas = persistent(prefix + " levels", atlas.width(), atlas.height());
  std::vector<LevelDraw> draws;
  for (int level = 0; level <= atlas.lastLevel; ++level) {
    const LevelImage& image = images.back().imageWidth >= atlas.side(level) ? images.back() : images.front();
    auto program = reduction(image.imageWidth / atlas.side(level));
    if (!program) return program.error();
    draws.push_back({*program, image, atlas.rect(level)});
  }
  addLevelPass(frame.graph, prefix + " levels", pyramid.atlas, std::move(draws),
               combineKeys(depth.contentKey, 0xa71a5u));
  return pyramid;
}

void addBlockerPyramid(ReceiverShading& shading, const LightDepth& depth, const BlockerPyramid& pyramid) {
  shading.textures.push_back({.sampler = "u_pyramid", .resource = pyramid.atlas});
  const MapSpace& space = depth.space;
  const double unit = space.depthUnit;
  const double range = (space.farthestCasterDepth - space.nearestCasterDepth) * unit;
  const glm::vec4 layout(pyramid.cells, pyramid.lastLevel, 1.0 / (pyramid.cells * pyramid.texelsPerCell), 0);
  const glm::vec4 casters(space.nearestCasterDepth * unit, range / 255.0, 0, 0);
  shading.setUniforms = [layout, casters, inner = std::move(shading.setUniforms)](gl::Program& program,
                                                                                  gl::Context& context) {
    inner(program, context);
    program.set(context, "u_pyramidLayout", layout);
    program.set(context, "u_pyramidRange", casters);
  };
}

}  // namespace halfshadow::techniques
