// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/edge_mask.hpp"

#include <algorithm>
#include <bit>

#include "base/keys.hpp"
#include "techniques/parts/maps/light_blocks.hpp"

namespace halfshadow::techniques {

Result<EdgeMask> declareEdgeMask(const LightFrame& frame, const LightDepth& depth,
                                 const EdgeMaskOptions& options) {
  const int size = depth.space.mapSize;
  if (!std::has_single_bit(static_cast<unsigned>(size))) {
    return Error{ErrorCode::invalidArgument,
                 "map_size=" + std::to_string(size) +
                     ": an edge mask needs a power of two, since its mip chain does the dilation"};
  }
  auto defines = depthDefines(depth.storage);
  if (options.filter == EdgeFilter::laplacian9) defines.push_back("HS_LAPLACIAN9");
  auto edges = frame.programs.get({"screen/fullscreen.vert", "map/edge_mask.frag", defines});
  if (!edges) return edges.error();
  auto dilate = frame.programs.get({"screen/fullscreen.vert", "map/edge_dilate.frag", {}});
  if (!dilate) return dilate.error();

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

  const std::string prefix = "light " + std::to_string(frame.lightIndex);
  const auto full = frame.graph.addResource({.name = prefix + " edges",
                                             .width = size,
                                             .height = size,
                                             .lifetime = framegraph::Lifetime::persistent,
                                             .filter = framegraph::Filter::linearMipNearest,
                                             .mipmapped = true});
  addFilterPass(frame.graph, {.name = prefix + " edges",
                              .program = *edges,
                              .source = depth.map,
                              .target = full,
                              .sourceSize = size,
                              .contentKey = key,
                              .sampler = "u_depthMap",
                              .setUniforms = [edge](gl::Program& program, gl::Context& context) {
                                program.set(context, "u_edge", edge);
                              }});

  // A bilinear fetch at level l reaches half a texel of that level beyond the nearest one: 2^(l-1) map
  // texels. Above level 4 the box filter of 8-bit mips loses a single edge texel (255 / 4^5 rounds to 0).
  int level = 1;
  while (level < 4 && (1 << (level - 1)) < options.radiusTexels - 0.5) ++level;
  const int target = std::max(size >> level, 1);
  EdgeMask mask;
  mask.mask = frame.graph.addResource({.name = prefix + " edge mask",
                                       .width = target,
                                       .height = target,
                                       .lifetime = framegraph::Lifetime::persistent,
                                       .filter = framegraph::Filter::linear});
  addFilterPass(frame.graph, {.name = prefix + " edge mask",
                              .program = *dilate,
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
