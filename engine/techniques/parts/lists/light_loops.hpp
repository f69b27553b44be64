// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Silhouettes of all casters of a light, seen from each of its sub-lights: what lists and volumes of casters
/// are made from.
#pragma once

#include "outlines/caster_loops.hpp"
#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

class LightLoops {
 public:
  /// Finds them anew when light, casters, sub-lights or settings changed: once a frame, however many ask.
  /// Casters that are left out are noted in the plan.
  void update(const LightScene& scene, PassPlan& plan, std::span<const outlines::SubLight> subLights);
  const scene::LightPlane& plane() const { return space_.plane; }
  const outlines::ListSpace& space() const { return space_; }
  /// What is nearer to the light's plane is cut: a thousandth of the light's smaller half side.
  double minHeight() const { return minHeight_; }
  /// Counts up whenever they were found anew.
  std::uint64_t generation() const { return generation_; }
  /// One entry per sub-light.
  std::span<const outlines::SubLightLoops> subLights() const { return subLights_; }

 private:
  std::uint64_t key_ = 0, generation_ = 0;
  outlines::ListSpace space_;
  double minHeight_ = 1.0;
  std::vector<scene::LightSilhouetteCache> silhouettes_;
  std::vector<outlines::SubLightLoops> subLights_;
};

}  // namespace halfshadow::techniques
