// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Least and greatest alpha over rectangles of an image.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene_description.hpp"

namespace halfshadow::scene {

/// Least and greatest alpha, of [0, 1].
struct AlphaRange {
  float low = 1.0f, high = 1.0f;
  void times(const AlphaRange& other) { low *= other.low, high *= other.high; }
};

/// Made once an image; each question then looks at a few texels.
class AlphaPyramid {
 public:
  /// An image of one channel holds alpha alone; one without alpha is 1 everywhere.
  explicit AlphaPyramid(const Image& image);
  AlphaRange all() const;
  /// Of all that a sampler reads at texture coordinates (v downward) from `low` to `high`, or of more: a
  /// range that holds it.
  AlphaRange over(const glm::dvec2& low, const glm::dvec2& high, const ImageSampling& sampling) const;

 private:
  struct Bytes {
    std::uint8_t low = 255, high = 0;
  };
  struct Level {
    int width = 0, height = 0;
    std::vector<Bytes> texels;
  };
  AlphaRange over(glm::ivec2 first, glm::ivec2 last) const;
  std::vector<Level> levels_;  ///< each half of the one before; none: no alpha
};

}  // namespace halfshadow::scene
