// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_width/attenuation.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::techniques {

double attenuation(double shadowDepth, double shadowWidth, const Attenuation& constants) {
  if (shadowDepth <= 0.0 || shadowWidth <= 0.0) return 1.0;
  return std::clamp(1.0 + constants.bias - constants.scale * shadowWidth / shadowDepth, 0.0, 1.0);
}

std::vector<std::uint8_t> attenuationTable(const Attenuation& constants) {
  std::vector<std::uint8_t> table;
  table.reserve(static_cast<std::size_t>(kAttenuationSide) * kAttenuationSide);
  for (int row = 0; row < kAttenuationSide; ++row) {
    for (int column = 0; column < kAttenuationSide; ++column) {
      const double visibility = attenuation(column / 255.0, row / 255.0, constants);
      table.push_back(static_cast<std::uint8_t>(std::lround(visibility * 255.0)));
    }
  }
  return table;
}

}  // namespace halfshadow::techniques
