// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

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
/// that the nearest caster leaves, and again with the answer (penumbra_bounds.glsl). Of a split light, over
/// all sub-lights' maps at once.
struct PenumbraBounds {
  framegraph::ResourceId atlas;
  int blockTexels = 8;  ///< side of a block of the finest level
  int blocks = 2;       ///< per side of the finest level; of one map a power of two
  int lastLevel = 0;    ///< of so few blocks per side that its reach is the whole map
};

/// Sides of the two images that levels are made from, and passes that write them. Reads of the maps of a
/// split light are merged in the first.
std::vector<LevelImage> planSources(PassPlan& plan, const LightDepth& depth, const std::string& prefix,
                                    const PenumbraBounds& bounds) {
  framegraph::ResourceId source = depth.map;
  int sourceSize = depth.atlasSize, factor = bounds.blockTexels;
  std::vector<LevelImage> images;
  for (int size = bounds.blocks; size >= 2 && images.size() < 2; size /= kReduction) {
    auto defines = depthDefines(depth.storage);
    defines.push_back("HS_FACTOR " + std::to_string(factor));
    if (images.empty()) {
      defines.push_back("HS_FROM_DEPTH");
      for (std::string& define : tileDefines(depth)) defines.push_back(std::move(define));
    }
    const std::string name = prefix + std::to_string(size);
    const auto target = plan.addImage(
        {.name = name, .width = size, .height = size, .lifetime = framegraph::Lifetime::persistent});
    addFilterPass(plan, {.name = name,
                         .fragmentFile = "map/block_bounds.frag",
                         .defines = defines,
                         .source = source,
                         .target = target,
                         .sourceSize = sourceSize,
                         .targetSize = size,
                         .contentKey = combineKeys(depth.contentKey, static_cast<std::uint64_t>(size)),
                         .sampler = "u_source"});
    images.push_back({target, size, size, {0, 0, size, size}});
    if (size % kReduction != 0) break;
    source = target;
    sourceSize = size;
    factor = kReduction;
  }
  return images;
}

PenumbraBounds planPenumbraBounds(const LightScene& scene, PassPlan& plan, const LightDepth& depth) {
  PenumbraBounds bounds;
  const int mapSize = depth.space.mapSize;
  while (bounds.blockTexels * kMostBlocks < mapSize) bounds.blockTexels *= 2;
  LevelAtlas atlas;
  while (atlas.finestSide * bounds.blockTexels < mapSize) atlas.finestSide *= 2;
  // No part of a block may lie in another sub-light's map.
  if (depth.subLights != nullptr) atlas.finestSide = mapSize / bounds.blockTexels;
  // The coarsest level's reach is the whole map.
  while (atlas.side(atlas.lastLevel) > kReachBlocks + 1) ++atlas.lastLevel;
  bounds.blocks = atlas.finestSide;
  bounds.lastLevel = atlas.lastLevel;
  const std::string prefix = scene.name + " penumbra bounds ";
  const std::vector<LevelImage> images = planSources(plan, depth, prefix, bounds);

  // Along one axis, then along the other.
  const auto levels = [&](const std::string& name) {
    return plan.addImage({.name = prefix + name,
                          .width = atlas.width(),
                          .height = atlas.height(),
                          .lifetime = framegraph::Lifetime::persistent});
  };
  const auto rows = levels("rows");
  bounds.atlas = levels("levels");
  std::vector<LevelDraw> rowDraws, levelDraws;
  for (int level = 0; level <= atlas.lastLevel; ++level) {
    const int side = atlas.side(level);
    const LevelImage& image = images.back().imageWidth >= side ? images.back() : images.front();
    rowDraws.push_back({"map/block_dilate.frag", dilationDefines(kReachBlocks, 0, image.imageWidth / side),
                        image, atlas.rect(level)});
    levelDraws.push_back({"map/block_dilate.frag",
                          dilationDefines(0, kReachBlocks, 1),
                          {rows, atlas.width(), atlas.height(), atlas.rect(level)},
                          atlas.rect(level)});
  }
  addLevelPass(plan, prefix + "rows", rows, rowDraws, combineKeys(depth.contentKey, 0xb0bd0u));
  addLevelPass(plan, prefix + "levels", bounds.atlas, levelDraws, combineKeys(depth.contentKey, 0xb0bd1u));
  return bounds;
}

}  // namespace

void addPenumbraBounds(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                       ReceiverShading& shading) {
  const PenumbraBounds bounds = planPenumbraBounds(scene, plan, depth);
  shading.textures.push_back({.sampler = "u_blockMap", .resource = bounds.atlas});
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

std::vector<Fallback> penumbraFallbacks() {
  return {shadedApart(),
          shadedApart({{"program_size", "short"}}, "short programs"),
          shadedApart({{"program_size", "short"}, {"sub_lights", "1"}},
                      "short programs over one map of the whole light"),
          {.text = "a kernel of one width", .technique = "pcf"}};
}

int filterSide(const LightDepth& depth, int side) {
  if (depth.subLights == nullptr) return side;
  // So many that all maps together take a few more taps than one map would, or some more where each map's own
  // search pays for itself.
  const double fewer = std::pow(depth.subLights->grid.count(), depth.subLights->oneSearch ? 0.25 : 0.125);
  return std::max(2, static_cast<int>(std::lround(side / fewer)));
}

double widestPenumbraTexels(const LightScene& scene, const MapSpace& space) {
  const double farthest =
      1.0 - space.nearDistance / std::max(scene.receiverFarDistance, scene.fit().farDistance);
  return std::max(space.kernelTexelsPerDepth.x, space.kernelTexelsPerDepth.y) *
         (farthest - space.nearestCasterDepth);
}

}  // namespace halfshadow::techniques
