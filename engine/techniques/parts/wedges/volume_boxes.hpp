// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Boxes around what a caster, or part of one, can shadow: frustums between two heights over the light, drawn
/// against the receivers' depth.
#pragma once

#include <array>
#include <span>

#include "outlines/wedge_pieces.hpp"
#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

/// A box is four corners at its nearer height and four at the farther one.
inline constexpr int kVolumeIndices = 36;
/// Boxes that 16-bit indices reach, when each has so many vertices.
constexpr std::size_t volumesPerDraw(int verticesPerVolume) {
  return 65536 / static_cast<std::size_t>(verticesPerVolume);
}

/// Where volumes end: at a height behind every receiver, and sideways at `sideways` from the light's axis.
struct VolumeReach {
  double end = 1.0, sideways = 1.0;
};
/// Half side of a square of (a, b) around every receiver, at least twice as wide: a power of two, so that it
/// seldom changes.
double sidewaysReach(const LightScene& scene, const scene::LightPlane& plane);

/// The extent at height h as (a, b, h), a little larger, so that rounding leaves no receiver outside.
std::array<glm::dvec3, 4> volumeCorners(const outlines::WedgeExtent& extent, double h,
                                        const VolumeReach& reach);

/// Points whose hull contains everything between the eye and the near plane's rectangle.
std::array<glm::dvec3, 5> eyeHull(const View& view, const scene::LightPlane& plane);
/// True when one side of the volume keeps all of the hull outside, with some to spare.
bool eyeOutside(const outlines::WedgeExtent& extent, const VolumeReach& reach,
                const std::array<glm::dvec3, 5>& hull);

/// The indices of a box, repeated for so many of them as one draw takes at most; counter-clockwise from
/// outside.
class VolumeIndices {
 public:
  /// Into the plan's buffers under `id`. Grows only.
  std::uint32_t addTo(PassPlan& plan, std::uint64_t id, std::size_t volumes, int verticesPerVolume);

 private:
  PlannedBuffer buffer_{.kind = PlannedBuffer::Kind::indices};
};

}  // namespace halfshadow::techniques
