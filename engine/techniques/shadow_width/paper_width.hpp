// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The paper's shadow-width map: distance of occluded texels to the nearest lit one, by iterated minimum.
#pragma once

#include <cstdint>
#include <vector>

#include "techniques/parts/maps/light_depth.hpp"

namespace halfshadow::techniques {

/// Where one iteration looks, and what it adds.
struct WidthStep {
  int differenceBytes = 1;
  std::vector<glm::ivec2> neighbours;  ///< offsets in texels
};

/// The paper's iterations: neighbour distances of 1, 2, 4 … texels, differences of 1, 2, 4 … times the first,
/// which is 255 / start bytes, until a difference exceeds 1. Three neighbours stand at 120 degrees, turned by
/// half a circle from step to step so that two steps look in six directions; six stand at 60.
std::vector<WidthStep> widthSteps(int neighbours, int start);

/// The same on the CPU, in place of an inverted occlusion map (255 inside casters, 0 outside); rows of `side`
/// bytes. Neighbours outside the map repeat its border, as a clamped fetch does.
void widthMapOnCpu(std::vector<std::uint8_t>& map, int side, const std::vector<WidthStep>& steps);

enum class WidthBuild { gpu, cpu };

/// Adds the passes; answers with the map: shadow width in all channels, linear filter.
framegraph::ResourceId planPaperWidth(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                                      const std::vector<WidthStep>& steps, WidthBuild build);

}  // namespace halfshadow::techniques
