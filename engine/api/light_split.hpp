// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How many sub-lights a light has in a frame, and what they see.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "planner/sub_lights.hpp"
#include "techniques/core/technique.hpp"

namespace halfshadow::api {

/// Kept beside the light: fitted again only when light, casters, texels or number change.
class LightSplit {
 public:
  struct Inputs {
    const scene::AreaLight& light;
    const planner::LightFit& fit;  ///< of the light seen whole
    std::span<const planner::CasterShape> casters;
    ListChanges casterChanges;
    double receiverFarDistance = 0.0;
    std::uint64_t contentKey = 0;  ///< of light and casters
    int mostTexels = 0;            ///< a side of a texture
  };
  /// Null: it is seen whole. `reason` then tells why, or why it is split, when the technique splits lights.
  const planner::SubLights* update(const Inputs& inputs, const techniques::Technique& technique,
                                   const techniques::Settings& settings, std::string& reason);

 private:
  planner::SubLights split_;
  planner::LightFitter fitter_;
  std::uint64_t contentKey_ = 0;
  int mapSize_ = 0;
};

}  // namespace halfshadow::api
