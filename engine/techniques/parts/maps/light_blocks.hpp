// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What is made of the depth map once per light change, so that receivers decide with one fetch: conservative
/// depth bounds of blocks, and a pyramid of occupancy and mean depth.
#pragma once

#include "techniques/core/fallback.hpp"
#include "techniques/parts/maps/light_depth.hpp"

namespace halfshadow::techniques {

/// Smallest and largest depth around each block, for kernels that reach at most `radiusTexels`.
struct BlockBounds {
  framegraph::ResourceId map;
  int blockTexels = 8;
  double radiusTexels = 0.0;
};
/// Reduces in steps of at most 4 x 4 texels to blocks of at least a quarter of the radius, then merges the
/// neighbours that the radius reaches.
BlockBounds planBlockBounds(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                            double radiusTexels);
/// Adds the mask's texture and uniform to a receiver program that includes block_mask.glsl.
void addBlockMask(ReceiverShading& shading, const BlockBounds& bounds);

/// Taps a side of the filter of each map, where `side` is what one map of the whole light has.
int filterSide(const LightDepth& depth, int side);

/// Width in texels of the widest penumbra that a receiver inside the fitted view can have.
double widestPenumbraTexels(const LightScene& scene, const MapSpace& space);

/// Fallbacks of filters that follow the penumbra; the last takes another technique.
std::vector<Fallback> penumbraFallbacks();
/// Adds bounds and penumbra scale to a receiver program that includes penumbra_bounds.glsl, and the way of
/// skipping that goes with them: they find the lit and the umbra receivers.
void addPenumbraBounds(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                       ReceiverShading& shading);

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
Result<BlockerPyramid> planBlockerPyramid(const LightScene& scene, PassPlan& plan, const LightDepth& depth);
/// Adds texture and uniforms to a receiver program that includes blocker_pyramid.glsl.
void addBlockerPyramid(ReceiverShading& shading, const LightDepth& depth, const BlockerPyramid& pyramid);

/// For techniques that take the mean blocker from the pyramid: receivers that cast search by taps instead,
/// since a mean over a region takes their own surface for a blocker; so do those with casters beyond them,
/// which block nothing and yet share cells with what does.
void addSelfReceiverSearch(const LightScene& scene, ReceiverShading& shading);

/// Adds to plan.shading how the mean blocker is found: by the pyramid and addSelfReceiverSearch(), or by taps
/// alone where programs are to be short. Errors: those of planBlockerPyramid().
Status addBlockerSearch(const LightScene& scene, PassPlan& plan, const LightDepth& depth);

/// False only when no caster reaches beyond the receiver as seen from the light: all lie on the light's side
/// of its plane. Receivers that are not flat, or too dense to look at in each frame, may have casters beyond.
bool mayHaveCastersBeyond(const LightScene& scene, const DrawItem& receiver);

/// True when a caster lies wholly behind a flat receiver that casts nothing, as seen from the light's centre:
/// a view of the casters shows it as if it were before that receiver.
bool hasCastersBehindReceivers(const LightScene& scene);

}  // namespace halfshadow::techniques
