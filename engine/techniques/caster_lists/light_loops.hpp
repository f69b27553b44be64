// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Silhouettes of all casters of a light, seen from each of its sub-lights: what lists and volumes of casters
/// are made from.
#pragma once

#include "techniques/caster_lists/cell_loops.hpp"
#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

class LightLoops {
 public:
  /// Heights are in units of the casters' farthest distance, or up to twice that. What is nearer to the
  /// light's plane is cut.
  static constexpr double kMinHeight = 1e-3;

  /// True when they were found anew: light, casters or settings changed.
  bool update(const LightFrame& frame, std::span<const SubLight> subLights);
  const scene::LightPlane& plane() const { return plane_; }
  /// One entry per sub-light.
  std::span<const SubLightLoops> subLights() const { return subLights_; }
  /// World distance by which receivers that cast are moved off their surface, along its normal.
  double lift() const { return lift_; }

 private:
  std::uint64_t key_ = 0;
  scene::LightPlane plane_;
  std::vector<scene::LightSilhouetteCache> silhouettes_;
  std::vector<SubLightLoops> subLights_;
  double lift_ = 0.0;
};

}  // namespace halfshadow::techniques
