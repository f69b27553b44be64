// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Reproducible numbers: the same everywhere for the same seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace halfshadow::stress {

/// Based on: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014, section 4
/// (SplitMix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
  }
  /// 0 … count - 1.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }
  glm::dvec3 direction() {
    // Rejection: uniform over the sphere.
    while (true) {
      const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
      const double square = x * x + y * y + z * z;
      if (square > 0.01 && square <= 1.0) return glm::dvec3(x, y, z) / std::sqrt(square);
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace halfshadow::stress
