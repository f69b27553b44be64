// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "base/keys.hpp"
#include "techniques/parts/maps/filter_pass.hpp"
#include "techniques/parts/maps/level_atlas.hpp"
#include "techniques/parts/maps/light_blocks.hpp"

namespace halfshadow::techniques {

std::vector<std::string> dilationDefines(int reachS, int reachT, int cellTexels) {
  return {"HS_REACH_S " + std::to_string(reachS), "HS_REACH_T " + std::to_string(reachT),
          "HS_CELL " + std::to_string(cellTexels)};
}

BlockBounds planBlockBounds(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                            double radiusTexels) {
  // Without highp a tap's offset along the receiver's plane is off by up to .01 of the kernel's radius.
  const double rounding = depth.storage == DepthStorage::packed16 ? 0.02 * radiusTexels : 0.0;
  BlockBounds bounds{.radiusTexels = radiusTexels + rounding};
  // Small blocks are tight but need a longer reach to cover the kernel; at most 9 x 9 fetches of a small
  // image.
  constexpr int kLongestReach = 4;
  bounds.blockTexels = 4;
  // Nothing is beyond the map, however wide the kernel.
  const double covered = std::min<double>(radiusTexels, depth.space.mapSize);
  while (bounds.blockTexels * kLongestReach < std::ceil(covered)) bounds.blockTexels *= 2;
  const int reach = std::max(1, static_cast<int>(std::ceil(covered / bounds.blockTexels)));
  int size = depth.space.mapSize;
  const std::string prefix = scene.name + " block bounds ";
  framegraph::ResourceId source = depth.map;
  int remaining = bounds.blockTexels;
  bool fromDepth = true;
  while (remaining > 1 || fromDepth) {
    const int factor = remaining % 4 == 0 ? 4 : 2;
    auto defines = depthDefines(depth.storage);
    defines.push_back("HS_FACTOR " + std::to_string(factor));
    if (fromDepth) defines.push_back("HS_FROM_DEPTH");
    const int targetSize = (size + factor - 1) / factor;
    const std::string name = prefix + std::to_string(targetSize);
    const auto target = plan.addImage({.name = name,
                                       .width = targetSize,
                                       .height = targetSize,
                                       .lifetime = framegraph::Lifetime::persistent});
    const std::uint64_t key = combineKeys(depth.contentKey, static_cast<std::uint64_t>(targetSize));
    addFilterPass(plan, {.name = name,
                         .fragmentFile = "map/block_bounds.frag",
                         .defines = defines,
                         .source = source,
                         .target = target,
                         .sourceSize = size,
                         .targetSize = targetSize,
                         .contentKey = key,
                         .sampler = "u_source"});
    source = target;
    size = targetSize;
    remaining /= factor;
    fromDepth = false;
  }
  const std::string name = prefix + "dilated";
  bounds.map = plan.addImage(
      {.name = name, .width = size, .height = size, .lifetime = framegraph::Lifetime::persistent});
  const std::uint64_t key =
      combineKeys(depth.contentKey, 0xd11a7e00u + static_cast<std::uint64_t>(size * 16 + reach));
  const Rect whole{0, 0, size, size};
  addLevelPass(
      plan, name, bounds.map,
      {{"map/block_dilate.frag", dilationDefines(reach, reach, 1), {source, size, size, whole}, whole}}, key);
  return bounds;
}

void addBlockMask(ReceiverShading& shading, const BlockBounds& bounds) {
  shading.textures.push_back({.sampler = "u_blockMap", .resource = bounds.map});
  // A hundredth of a texel more than the kernel: rounding of the plane offset must not fall outside.
  const glm::vec4 mask(bounds.radiusTexels + 0.01, 0, 0, 0);
  shading.uniforms.set("u_mask", mask);
}

}  // namespace halfshadow::techniques
