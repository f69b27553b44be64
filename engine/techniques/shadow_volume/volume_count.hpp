// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Counting, per pixel, the surfaces between the light's centre and the receiver: by stencil or by blending.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "techniques/shadow_volume/volume_cache.hpp"
#include "techniques/shadow_volume/volume_view.hpp"

namespace halfshadow::techniques {

enum class VolumeCounter {
  stencil,  ///< two-sided, wrapping, one draw a caster
  blend     ///< one channel of the colour target, two draws a caster; needs no stencil
};
/// Layers that one channel or stencil value holds: all 8 bits of a stencil, since it wraps within a batch; in
/// a channel, which saturates, room is left for what one draw adds before the next subtracts it.
int maxVolumeLayers(VolumeCounter counter);

/// How one caster of one light is counted. Pointers last while the light is planned.
struct VolumeDraw {
  const CachedVolume* volume = nullptr;
  std::uint32_t firstChunk = 0, lastChunk = 0;
  VolumeSurface surface = VolumeSurface::sides;
  bool depthFail = false;  ///< counts what lies behind the receiver, else what lies in front
  bool mirrored = false;   ///< its triangles turn round
  glm::mat4 clipFromObject{1.0f};
  std::optional<Rect> scissor;
};
/// Draws whose layers fit a counter together.
struct VolumeBatch {
  std::vector<VolumeDraw> draws;
  std::optional<Rect> scissor;  ///< of them all
};
struct LightVolumes {
  std::vector<VolumeBatch> batches;
  glm::mat4 clipFromDirection{1.0f};
};

/// Extracts and sorts what the light's casters need; notes in the plan which casters need no caps and which
/// are out of view.
LightVolumes lightVolumes(const LightScene& scene, PassPlan& plan, const VolumeView& view, VolumeCache& cache,
                          VolumeCounter counter);

/// The receivers' depths as volumes meet them: into a cleared depth buffer, before counting.
PlannedDraw volumeReceivers(PassPlan& plan, const VolumeView& view, std::span<const DrawItem> receivers);

/// Counts into the pass's stencil, zero before and after, and writes black to `channel` (0-3) of its colour
/// where the light's centre is hidden. Or, by blending, counts in that channel, zero before: afterwards it is
/// zero exactly where the centre is seen.
void addVolumeCounts(PassPlan& plan, PlannedPass& pass, const LightVolumes& volumes, VolumeCounter counter,
                     int channel);

}  // namespace halfshadow::techniques
