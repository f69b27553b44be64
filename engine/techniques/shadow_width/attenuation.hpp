// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The paper's attenuation of light inside the hard shadow.
#pragma once

#include <cstdint>
#include <vector>

namespace halfshadow::techniques {

struct Attenuation {
  double scale = 1.0;  ///< c_scale: the larger, the narrower the penumbra
  double bias = 0.05;  ///< c_bias: share of light added at the shadow's border
};

/// Visibility of a point whose occluder is `shadowDepth` >= 0 in front of it and whose nearest lit neighbour
/// in the width map is `shadowWidth` >= 0 away: 1 + bias - scale · width / depth, in [0, 1]; 1 where either
/// is 0. Based on: Kirsch, Döllner 2003, section 3.
double attenuation(double shadowDepth, double shadowWidth, const Attenuation& constants);

inline constexpr int kAttenuationSide = 256;
/// Bytes of the lookup texture: shadow depth i/255 along columns, shadow width j/255 along rows.
std::vector<std::uint8_t> attenuationTable(const Attenuation& constants);

}  // namespace halfshadow::techniques
