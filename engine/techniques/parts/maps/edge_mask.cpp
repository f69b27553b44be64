// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/edge_mask.hpp"

#include <algorithm>
#include <bit>

#include "base/keys.hpp"
#include "techniques/parts/maps/filter_pass.hpp"

namespace halfshadow::techniques {

Result<EdgeMask> planEdgeMask(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                              const EdgeMaskOptions& options) {
  const int size = depth.space.mapSize;
  if (!std::has_single_bit(static_cast<unsigned>(size))) {
    return Error{ErrorCode::invalidArgument,
                 "map_size=" + std::to_string(size) +
                     ": an edge mask needs a power of two, since its mip chain does the dilation"};
  }
  auto defines = depthDefines(depth.storage);
  if (options.filter == EdgeFilter::laplacian9) defines.push_back("HS_LAPLACIAN9");

  glm::vec4 edge(options.strengthPerDepth / depth.space.depthUnit, glm::vec3(options.thresholds));
  if (options.strengthPerDepth <= 0.0) {
    // Sixteen differences of up to two quanta each, and the slack of a plane seen through rounding.
    const double threshold = 32.0 * depth.space.quantum * depth.space.depthUnit;
    edge = glm::vec4(1.0, threshold, threshold, threshold);
  }
  const bool nine = options.filter == EdgeFilter::laplacian9;
  std::uint64_t key = combineKeys(depth.contentKey, nine ? 9 : 5);
  for (const float value : {edge.x, edge.y, edge.z, edge.w})
    key = combineKeys(key, std::bit_cast<std::uint32_t>(value));

  const std::string prefix = scene.name;
  const auto full = plan.addImage({.name = prefix + " edges",
                                   .width = size,
                                   .height = size,
                                   .lifetime = framegraph::Lifetime::persistent,
                                   .filter = framegraph::Filter::linearMipNearest,
                                   .mipmapped = true});
  device::UniformList uniforms;
  uniforms.set("u_edge", edge);
  addFilterPass(plan, {.name = prefix + " edges",
                       .fragmentFile = "map/edge_mask.frag",
                       .defines = defines,
                       .source = depth.map,
                       .target = full,
                       .sourceSize = size,
                       .contentKey = key,
                       .sampler = "u_depthMap",
                       .uniforms = std::move(uniforms)});

  // A bilinear fetch at level l reaches half a texel of that level beyond the nearest one: 2^(l-1) map
  // texels. Above level 4 the box filter of 8-bit mips loses a single edge texel (255 / 4^5 rounds to 0).
  int level = 1;
  while (level < 4 && (1 << (level - 1)) < options.radiusTexels - 0.5) ++level;
  const int target = std::max(size >> level, 1);
  EdgeMask mask;
  mask.mask = plan.addImage({.name = prefix + " edge mask",
                             .width = target,
                             .height = target,
                             .lifetime = framegraph::Lifetime::persistent,
                             .filter = framegraph::Filter::linear});
  addFilterPass(plan, {.name = prefix + " edge mask",
                       .fragmentFile = "map/edge_dilate.frag",
                       .source = full,
                       .target = mask.mask,
                       .sourceSize = size,
                       .contentKey = combineKeys(key, static_cast<std::uint64_t>(level)),
                       .sampler = "u_source"});
  return mask;
}

void addEdgeMask(ReceiverShading& shading, const EdgeMask& mask) {
  shading.textures.push_back({.sampler = "u_edgeMask", .resource = mask.mask});
}

}  // namespace halfshadow::techniques
