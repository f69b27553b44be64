// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <bit>

#include "base/keys.hpp"
#include "techniques/parts/maps/filter_pass.hpp"
#include "techniques/parts/maps/level_atlas.hpp"
#include "techniques/parts/maps/light_blocks.hpp"

namespace halfshadow::techniques {
namespace {
/// Cells of the second source image are this much larger.
constexpr int kReduction = 8;
/// Per side of the finest level.
constexpr int kFewestCells = 16;
}  // namespace

Result<BlockerPyramid> planBlockerPyramid(const LightScene& scene, PassPlan& plan, const LightDepth& depth) {
  BlockerPyramid pyramid;
  LevelAtlas atlas;
  const int tiles = depth.tilesPerSide();
  pyramid.cells = depth.space.mapSize / pyramid.texelsPerCell;
  atlas.finestSide = pyramid.cells * tiles;
  if (depth.subLights == nullptr &&
      (!std::has_single_bit(static_cast<unsigned>(depth.space.mapSize)) || pyramid.cells < kFewestCells)) {
    return Error{ErrorCode::invalidArgument, "map_size=" + std::to_string(depth.space.mapSize) +
                                                 ": a blocker pyramid needs a power of two of at least 64"};
  }
  const auto cells = [&](int level) { return pyramid.cells >> level; };
  while (cells(atlas.lastLevel) > 2 && cells(atlas.lastLevel) % 2 == 0) ++atlas.lastLevel;
  pyramid.lastLevel = atlas.lastLevel;

  const auto reduction = [](int factor, const LevelImage& source, const Rect& target) {
    return LevelDraw{"map/occupancy_level.frag", {"HS_CELL " + std::to_string(factor)}, source, target};
  };
  const std::string prefix = scene.name + " blockers";
  const auto persistent = [&](const std::string& name, int width, int height) {
    return plan.addImage(
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
  device::UniformList uniforms;
  uniforms.set("u_casterRange", casterRange);
  addFilterPass(plan, {.name = prefix + " " + std::to_string(side),
                       .fragmentFile = "map/occupancy.frag",
                       .defines = depthDefines(depth.storage),
                       .source = depth.map,
                       .target = images.front().image,
                       .sourceSize = depth.atlasSize,
                       .contentKey = combineKeys(depth.contentKey, 0x0cc0u),
                       .sampler = "u_depthMap",
                       .uniforms = std::move(uniforms)});
  if (side / kReduction >= 2 && pyramid.cells % kReduction == 0) {
    // What coarse levels are made of, so that no texel reads hundreds.
    const int small = side / kReduction;
    images.push_back(
        {persistent(prefix + " " + std::to_string(small), small, small), small, small, {0, 0, small, small}});
    addLevelPass(plan, prefix + " " + std::to_string(small), images.back().image,
                 {reduction(kReduction, images.front(), images.back().rect)},
                 combineKeys(depth.contentKey, 0x0cc1u));
  }
  pyramid.atlas = persistent(prefix + " levels", atlas.width(), atlas.height());
  std::vector<LevelDraw> draws;
  for (int level = 0; level <= atlas.lastLevel; ++level) {
    const LevelImage& image = images.back().imageWidth >= atlas.side(level) ? images.back() : images.front();
    draws.push_back(reduction(image.imageWidth / atlas.side(level), image, atlas.rect(level)));
  }
  addLevelPass(plan, prefix + " levels", pyramid.atlas, draws, combineKeys(depth.contentKey, 0xa71a5u));
  return pyramid;
}

void addBlockerPyramid(ReceiverShading& shading, const LightDepth& depth, const BlockerPyramid& pyramid) {
  shading.textures.push_back({.sampler = "u_pyramid", .resource = pyramid.atlas});
  const MapSpace& space = depth.space;
  const double unit = space.depthUnit;
  const double range = (space.farthestCasterDepth - space.nearestCasterDepth) * unit;
  const glm::vec4 layout(pyramid.cells, pyramid.lastLevel, 1.0 / (pyramid.cells * pyramid.texelsPerCell), 0);
  const glm::vec4 casters(space.nearestCasterDepth * unit, range / 255.0, 0, 0);
  shading.uniforms.set("u_pyramidLayout", layout);
  shading.uniforms.set("u_pyramidRange", casters);
}

Status addBlockerSearch(const LightScene& scene, PassPlan& plan, const LightDepth& depth) {
  if (hasShortPrograms(scene)) {
    plan.shading.defines.emplace_back("HS_SEARCH 5");
    plan.shading.defines.emplace_back("HS_SHORT");
    return {};
  }
  auto pyramid = planBlockerPyramid(scene, plan, depth);
  if (!pyramid) return pyramid.error();
  addSelfReceiverSearch(scene, plan.shading);
  addBlockerPyramid(plan.shading, depth, *pyramid);
  return {};
}

}  // namespace halfshadow::techniques
