// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What is made of the depth map once per light change, so that receivers decide with one fetch: conservative
/// depth bounds of blocks, and a pyramid of occupancy and mean depth.
#pragma once

#include "techniques/light_depth/light_depth.hpp"

namespace halfshadow::techniques {

/// Smallest and largest depth around each block, for kernels that reach at most `radiusTexels`.
struct BlockBounds {
  framegraph::ResourceId map;
  int blockTexels = 8;
  double radiusTexels = 0.0;
};
/// Reduces in steps of at most 4 x 4 texels, then merges 3 x 3 blocks; the block is the smallest power of two
/// that is at least the radius rounded up (and at least 4). Errors: invalidArgument when the map is smaller than
/// four blocks.
Result<BlockBounds> declareBlockBounds(const LightFrame& frame, const LightDepth& depth, double radiusTexels);
/// Adds the mask's texture and uniform to a receiver program that includes block_mask.glsl.
void addBlockMask(ReceiverShading& shading, const BlockBounds& bounds);

/// Occupied share and share times normalised depth, all mip levels in one atlas.
struct BlockerPyramid {
  framegraph::ResourceId atlas;
  int baseSize = 256;
  int lastLevel = 0;
  int texelsPerBase = 4;
};
Result<BlockerPyramid> declareBlockerPyramid(const LightFrame& frame, const LightDepth& depth);
/// Adds texture and uniforms to a receiver program that includes blocker_pyramid.glsl.
void addBlockerPyramid(ReceiverShading& shading, const LightDepth& depth, const BlockerPyramid& pyramid);

/// A pass that draws one full-screen triangle with `program`, reading one resource as `sampler`.
struct FilterPass {
  std::string name;
  gl::Program* program = nullptr;
  framegraph::ResourceId source, target;
  int sourceSize = 0;
  std::uint64_t contentKey = 0;
  gl::UniformKey sampler;
  std::function<void(gl::Program&, gl::Context&)> setUniforms;
};
void addFilterPass(framegraph::Graph& graph, FilterPass pass);

}  // namespace halfshadow::techniques
