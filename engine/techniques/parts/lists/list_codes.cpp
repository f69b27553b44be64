// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/list_codes.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::techniques {
namespace {
/// Exponents of steps, as stored.
constexpr int kExponentBias = 128;
}  // namespace

ListPlacement placementAbout(const glm::vec3& center, glm::vec3 least) {
  // The centre must be in reach. That step is what single precision knows of such coordinates.
  least = glm::max(least, glm::abs(center) / (32766.0f * kCenterSteps));
  const auto stepAbove = [](float length) {
    const int exponent = static_cast<int>(std::ceil(std::log2(std::max(length, 1e-36f))));
    return std::exp2(static_cast<float>(std::clamp(exponent, -kExponentBias + 4, kExponentBias - 2)));
  };
  const float stepT = stepAbove(std::max(least.x, least.y));
  ListPlacement placement{.center = center, .step = {stepT, stepT, stepAbove(least.z)}};
  // With eleven bits, which half precision has too; vertices are counted from there, whatever it is.
  for (int k = 0; k < 3; ++k) {
    const float code = std::round(center[k] / (kCenterSteps * placement.step[k]));
    const float unit =
        std::exp2(std::max(std::ceil(std::log2(std::max(std::abs(code), 1.0f))) - 11.0f, 0.0f));
    placement.center[k] = std::round(code / unit) * unit * kCenterSteps * placement.step[k];
  }
  return placement;
}

void encodePlacement(const ListPlacement& placement, std::uint8_t* texels) {
  const glm::vec3 center = placement.center / (kCenterSteps * placement.step);
  for (int k = 0; k < 3; ++k) putCode(center[k], texels + 2 * k);
  texels[6] = static_cast<std::uint8_t>(std::ilogb(placement.step.x) + kExponentBias);
  texels[7] = static_cast<std::uint8_t>(std::ilogb(placement.step.z) + kExponentBias);
}

}  // namespace halfshadow::techniques
