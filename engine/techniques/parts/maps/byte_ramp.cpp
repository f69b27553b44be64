// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/byte_ramp.hpp"

#include <algorithm>

namespace halfshadow::techniques {
namespace {
constexpr const char* kName = "byte ramp";

/// Texel (x, y): the high byte and a half bit come from x = floor(512·d), the low byte from
/// y = floor(256·fract(256·d)). The two coordinates are interpolated separately, so near a border of the high
/// byte they may disagree by one; the half bit tells which side is meant and corrects the high byte.
Pixels rampPixels() {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(512 * 256 * 4);
  for (int low = 0; low < 256; ++low) {
    for (int x = 0; x < 512; ++x) {
      int high = x >> 1;
      const bool upperHalf = (x & 1) != 0;
      if (upperHalf && low < 64) ++high;     // low wrapped before x did
      if (!upperHalf && low >= 192) --high;  // x stepped before low wrapped
      int stored = low;
      if (high > 255) high = 255, stored = 255;
      if (high < 0) high = 0, stored = 0;
      pixels.insert(pixels.end(),
                    {static_cast<std::uint8_t>(high), static_cast<std::uint8_t>(stored), 0, 255});
    }
  }
  return std::make_shared<const std::vector<std::uint8_t>>(std::move(pixels));
}
}  // namespace

std::uint32_t addByteRamp(PassPlan& plan) {
  const auto known = std::ranges::find(plan.textures, kName, &PlannedTexture::name);
  if (known != plan.textures.end()) return static_cast<std::uint32_t>(known - plan.textures.begin());
  return plan.addTexture({.name = kName,
                          .desc = {.width = 512, .height = 256, .wrap = device::TextureWrap::repeat},
                          .key = 1,
                          .forAllLights = true,
                          .pixels = rampPixels});
}

}  // namespace halfshadow::techniques
