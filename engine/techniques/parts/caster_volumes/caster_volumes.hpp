// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// One volume a caster: the box that it shadows, with the list of its silhouette's vertices. CPU only.
#pragma once

#include "outlines/tile_lists.hpp"
#include "techniques/parts/wedges/volume_boxes.hpp"
#include "techniques/parts/wedges/wedge_volumes.hpp"

namespace halfshadow::techniques {

/// Receivers at heights from `from` to `end` that a caster, or a layer of one, can shadow.
struct CasterVolume {
  std::uint32_t subLight = 0;
  std::uint32_t caster = 0;  ///< of the sub-light
  std::uint32_t batch = 0;
  WedgePart part = WedgePart::beyond;
  outlines::WedgeExtent extent;
  double from = 0.0, end = 0.0;
  std::uint32_t list = 0;  ///< in CasterVolumes::lists.tiles
  float splitI = 0.0f;     ///< reciprocal height up to which receivers are behind the whole caster
  /// Others answer for receivers with an i above `fromI`, or not above `untilI`: see outlines::CasterCluster.
  float fromI = 1e30f, untilI = -1e30f;
};

struct CasterVolumes {
  outlines::TileLists lists;          ///< one "tile" a list
  std::vector<CasterVolume> volumes;  ///< by sub-light, then by batch, then by part
  std::vector<bool> lightEnclosed;    ///< per sub-light: nothing outside a caster around it is lit
  std::uint32_t batchCount = 0;       ///< most of any sub-light
};

enum class Batching {
  none,     ///< all in batch 0
  disjoint  ///< volumes of one sub-light and batch have no receiver in common
};

/// Every caster has a volume for receivers at its own heights, the sides of a sheet one together; behind it,
/// it has another, or its layers have, up to where its cluster does.
CasterVolumes casterVolumes(std::span<const outlines::SubLightLoops> subLights,
                            const outlines::ListSpace& space, const VolumeReach& reach, Batching batching);

}  // namespace halfshadow::techniques
