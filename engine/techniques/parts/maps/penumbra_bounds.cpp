// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/keys.hpp"
#include "techniques/parts/maps/filter_pass.hpp"
#include "techniques/parts/maps/level_atlas.hpp"
#include "techniques/parts/maps/light_blocks.hpp"

namespace halfshadow::techniques {
namespace {
/// Blocks of the second source image are this much larger.
constexpr int kReduction = 8;
/// Blocks per side of the finest level at most: finer ones bound no penumbra more tightly that is wide enough
/// to need a filter.
constexpr int kMostBlocks = 128;
/// Blocks that a level reaches beyond its own: the answer holds what lies 1 to 2.5 times as far as was asked.
constexpr int kReachBlocks = 4;

/// Smallest and largest depth around each block at all block sizes, in one atlas: readers ask at the reach
/// that the nearest caster leaves, and again with the answer (penumbra_bounds.glsl). Of a split light, each
/// level has a tile for each sub-light's map; blocks count in one of them.
struct PenumbraBounds {
  framegraph::ResourceId atlas;
  std::optional<framegraph::ResourceId> merged;  ///< of all sub-lights' maps, laid out as of one
  int blockTexels = 8;                           ///< side of a block of the finest level
  int blocks = 2;                                ///< per side of the finest level
  int lastLevel = 0;
};

/// Levels as they are for one of `tiles` x `tiles` maps.
LevelAtlas oneTile(const LevelAtlas& atlas, int tiles) {
  return {atlas.finestSide / tiles, atlas.lastLevel};
}

PenumbraBounds planPenumbraBounds(const LightScene& scene, PassPlan& plan, const LightDepth& depth) {
  PenumbraBounds bounds;
  const int mapSize = depth.atlasSize, tiles = depth.tilesPerSide();
  while (bounds.blockTexels * kMostBlocks < mapSize) bounds.blockTexels *= 2;
  LevelAtlas atlas{.finestSide = tiles};
  while (atlas.finestSide * bounds.blockTexels < mapSize) atlas.finestSide *= 2;
  if (depth.subLights != nullptr) atlas.finestSide = mapSize / bounds.blockTexels;
  // The coarsest level's reach is the whole map.
  while (atlas.side(atlas.lastLevel) > tiles * (kReachBlocks + 1)) ++atlas.lastLevel;
  bounds.blocks = atlas.finestSide / tiles;
  bounds.lastLevel = atlas.lastLevel;

  const std::string prefix = scene.name + " penumbra bounds ";
  const auto persistent = [&](const std::string& name, int width, int height) {
    return plan.addImage({.name = prefix + name,
                          .width = width,
                          .height = height,
                          .lifetime = framegraph::Lifetime::persistent});
  };
  framegraph::ResourceId source = depth.map;
  int sourceSize = mapSize, factor = bounds.blockTexels;
  std::vector<LevelImage> images;
  for (int size = atlas.finestSide; size >= 2 && images.size() < 2; size /= kReduction) {
    auto defines = depthDefines(depth.storage);
    defines.push_back("HS_FACTOR " + std::to_string(factor));
    if (images.empty()) defines.push_back("HS_FROM_DEPTH");
    const auto target = persistent(std::to_string(size), size, size);
    addFilterPass(plan, {.name = prefix + std::to_string(size),
                         .fragmentFile = "map/block_bounds.frag",
                         .defines = defines,
                         .source = source,
                         .target = target,
                         .sourceSize = sourceSize,
                         .targetSize = size,
                         .contentKey = combineKeys(depth.contentKey, static_cast<std::uint64_t>(size)),
                         .sampler = "u_source"});
    images.push_back({target, size, size, {0, 0, size, size}});
    if (tiles > 1 && bounds.blocks % kReduction != 0) break;
    source = target;
    sourceSize = size;
    factor = kReduction;
  }

  // Along one axis, then along the other.
  const auto rows = persistent("rows", atlas.width(), atlas.height());
  bounds.atlas = persistent("levels", atlas.width(), atlas.height());
  std::vector<LevelDraw> rowDraws, levelDraws;
  for (int level = 0; level <= atlas.lastLevel; ++level) {
    const int side = atlas.side(level);
    const LevelImage& image = images.back().imageWidth >= side ? images.back() : images.front();
    rowDraws.push_back({"map/block_dilate.frag",
                        dilationDefines(kReachBlocks, 0, image.imageWidth / side, depth), image,
                        atlas.rect(level)});
    levelDraws.push_back({"map/block_dilate.frag",
                          dilationDefines(0, kReachBlocks, 1, depth),
                          {rows, atlas.width(), atlas.height(), atlas.rect(level)},
                          atlas.rect(level)});
  }
  addLevelPass(plan, prefix + "rows", rows, rowDraws, combineKeys(depth.contentKey, 0xb0bd0u));
  addLevelPass(plan, prefix + "levels", bounds.atlas, levelDraws, combineKeys(depth.contentKey, 0xb0bd1u));
  if (depth.subLights == nullptr) return bounds;

  const LevelAtlas one = oneTile(atlas, tiles);
  bounds.merged = persistent("merged", one.width(), one.height());
  std::vector<LevelDraw> mergedDraws;
  for (int level = 0; level <= one.lastLevel; ++level) {
    auto defines = tileDefines(depth);
    defines.push_back("HS_MAPS " + std::to_string(depth.subLights->grid.count()));
    mergedDraws.push_back({"map/block_merge.frag",
                           std::move(defines),
                           {bounds.atlas, atlas.width(), atlas.height(), atlas.rect(level)},
                           one.rect(level)});
  }
  addLevelPass(plan, prefix + "merged", *bounds.merged, mergedDraws, combineKeys(depth.contentKey, 0xb0bd2u));
  return bounds;
}

}  // namespace

void addPenumbraBounds(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                       ReceiverShading& shading) {
  const PenumbraBounds bounds = planPenumbraBounds(scene, plan, depth);
  shading.textures.push_back(
      {.sampler = "u_blockMap", .resource = bounds.merged ? *bounds.merged : bounds.atlas});
  if (bounds.merged) shading.textures.push_back({.sampler = "u_subLightBounds", .resource = bounds.atlas});
  const MapSpace& space = depth.space;
  // Half of the narrowest kernel and half a texel to its tap's centre; without highp a fragment's own place
  // is off by up to a texel.
  const double slack = depth.storage == DepthStorage::packed16 ? 2.0 : 1.0;
  const double texelsPerBlock = bounds.blockTexels;
  const glm::vec4 uniform(bounds.blocks, 1.0 / (texelsPerBlock * bounds.blocks), bounds.lastLevel, slack);
  const glm::vec4 penumbra(space.kernelTexelsPerDepth / space.depthUnit,
                           space.nearestCasterDepth * space.depthUnit, 1.0 / (texelsPerBlock * kReachBlocks));
  shading.uniforms.set("u_bounds", uniform);
  shading.uniforms.set("u_penumbra", penumbra);
  addHorizon(scene, depth, shading);
  shading.skip = preferredSkip(scene) == FilterSkip::stencil ? FilterSkip::stencil : FilterSkip::branch;
}

double widestPenumbraTexels(const LightScene& scene, const MapSpace& space) {
  const double farthest =
      1.0 - space.nearDistance / std::max(scene.receiverFarDistance, scene.fit().farDistance);
  return std::max(space.kernelTexelsPerDepth.x, space.kernelTexelsPerDepth.y) *
         (farthest - space.nearestCasterDepth);
}

}  // namespace halfshadow::techniques
