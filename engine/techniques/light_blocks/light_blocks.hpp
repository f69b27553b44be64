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
/// Reduces in steps of at most 4 x 4 texels to blocks of at least a quarter of the radius, then merges the
/// neighbours that the radius reaches.
Result<BlockBounds> declareBlockBounds(const LightFrame& frame, const LightDepth& depth, double radiusTexels);
/// Adds the mask's texture and uniform to a receiver program that includes block_mask.glsl.
void addBlockMask(ReceiverShading& shading, const BlockBounds& bounds);

/// Width in texels of the widest penumbra that a receiver inside the fitted view can have.
double widestPenumbraTexels(const LightFrame& frame, const MapSpace& space);

/// Smallest and largest depth around each block at all block sizes, in one atlas: readers ask at the reach
/// that the nearest caster leaves, and again with the answer (penumbra_bounds.glsl).
struct PenumbraBounds {
  framegraph::ResourceId atlas;
  int blockTexels = 8;  ///< side of a block of the finest level
  int blocks = 2;       ///< per side of the finest level, a power of two
  int lastLevel = 0;    ///< of two blocks per side
};
Result<PenumbraBounds> declarePenumbraBounds(const LightFrame& frame, const LightDepth& depth);
/// Adds bounds and penumbra scale to a receiver program that includes penumbra_bounds.glsl, and the way of
/// skipping that goes with them: they find the lit and the umbra receivers.
Status addPenumbraBounds(const LightFrame& frame, const LightDepth& depth, ReceiverShading& shading);

/// Defines of block_dilate.frag: bounds of cells of `cellTexels` source texels a side and of their neighbours
/// up to `reachS` and `reachT` cells away.
std::vector<std::string> dilationDefines(int reachS, int reachT, int cellTexels);

/// Occupied share and mean depth of cells of the map at all sizes, in one atlas.
struct BlockerPyramid {
  framegraph::ResourceId atlas;
  int cells = 256;        ///< per side of the finest level
  int texelsPerCell = 4;  ///< there
  int lastLevel = 0;      ///< of two cells per side
};
Result<BlockerPyramid> declareBlockerPyramid(const LightFrame& frame, const LightDepth& depth);
/// Adds texture and uniforms to a receiver program that includes blocker_pyramid.glsl.
void addBlockerPyramid(ReceiverShading& shading, const LightDepth& depth, const BlockerPyramid& pyramid);

/// For techniques that take the mean blocker from the pyramid: receivers that cast search by taps instead,
/// since a mean over a region takes their own surface for a blocker; so do those with casters beyond them,
/// which block nothing and yet share cells with what does.
void addSelfReceiverSearch(const LightFrame& frame, ReceiverShading& shading);

/// False only when no caster reaches beyond the receiver as seen from the light: all lie on the light's side
/// of its plane. Receivers that are not flat, or too dense to look at in each frame, may have casters beyond.
bool mayHaveCastersBeyond(const LightFrame& frame, const DrawItem& receiver);

/// True when a caster lies wholly behind a flat receiver that casts nothing, as seen from the light's centre:
/// a view of the casters shows it as if it were before that receiver.
bool hasCastersBehindReceivers(const LightFrame& frame);

/// A pass that draws one full-screen triangle with `program`, reading one resource as `sampler`.
struct FilterPass {
  std::string name;
  gl::Program* program = nullptr;
  framegraph::ResourceId source, target;
  int sourceSize = 0;
  int targetSize = 0;  ///< for shaders that ask which of its texels they write
  std::uint64_t contentKey = 0;
  gl::UniformKey sampler;
  std::function<void(gl::Program&, gl::Context&)> setUniforms;
};
void addFilterPass(framegraph::Graph& graph, FilterPass pass);

}  // namespace halfshadow::techniques
