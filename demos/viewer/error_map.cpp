// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/error_map.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::viewer {

Colour errorColour(double error, double full) {
  const double size = std::clamp(std::abs(error) / full, 0.0, 1.0);
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
  };
  // Up to the middle of the scale one colour grows, from there it turns into the other.
  const std::uint8_t strong = byte(2.0 * size), turning = byte(size < 0.5 ? size : 1.0 - size);
  const std::uint8_t middle = static_cast<std::uint8_t>(std::min(2 * turning, 255));
  return error >= 0.0 ? Colour{strong, middle, 0} : Colour{0, middle, strong};
}

ErrorMap errorMap(const std::vector<float>& measured, const TruthImage& truth, double full) {
  ErrorMap map{.statistics = metrics::errorStatistics(measured, truth.visibility, truth.kind)};
  map.rgba.reserve(measured.size() * 4);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    Colour colour{38, 38, 44};  // no receiver
    if (truth.kind[i] != 0) colour = errorColour(measured[i] - truth.visibility[i], full);
    map.rgba.insert(map.rgba.end(), {colour.r, colour.g, colour.b, 255});
  }
  return map;
}

}  // namespace halfshadow::viewer
