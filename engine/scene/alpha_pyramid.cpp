// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/alpha_pyramid.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::scene {
namespace {
/// Texels along a side that are looked at: levels are chosen so that a rectangle has no more.
constexpr int kMostTexels = 8;

/// Whether texels from `first` to `last` of one axis are neighbours in the image, too; then where.
bool inOnePeriod(double low, double high, int size, ImageWrap wrap, int& first, int& last) {
  if (!(std::abs(low) < 1e9) || !(std::abs(high) < 1e9)) return false;
  double from = std::floor(low), to = std::floor(high);
  if (wrap == ImageWrap::clampToEdge) {
    from = std::clamp(from, 0.0, size - 1.0);
    to = std::clamp(to, 0.0, size - 1.0);
  } else {
    const double period = std::floor(from / size);
    if (std::floor(to / size) != period) return false;
    from -= period * size, to -= period * size;
    if (wrap == ImageWrap::mirroredRepeat && std::fmod(std::abs(period), 2.0) == 1.0) {
      const double mirrored = size - 1.0 - to;
      to = size - 1.0 - from;
      from = mirrored;
    }
  }
  first = static_cast<int>(from), last = static_cast<int>(to);
  return true;
}
}  // namespace

AlphaPyramid::AlphaPyramid(const Image& image) {
  if (image.channels == 3 || image.width < 1 || image.height < 1) return;
  Level level{image.width, image.height, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  level.texels.reserve(image.pixels.size() / channels);
  for (std::size_t i = channels - 1; i < image.pixels.size(); i += channels)
    level.texels.push_back({image.pixels[i], image.pixels[i]});
  levels_.push_back(std::move(level));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& finer = levels_.back();
    Level coarser{(finer.width + 1) / 2, (finer.height + 1) / 2, {}};
    coarser.texels.resize(static_cast<std::size_t>(coarser.width) * static_cast<std::size_t>(coarser.height));
    for (int y = 0; y < finer.height; ++y) {
      for (int x = 0; x < finer.width; ++x) {
        const Bytes& texel = finer.texels[static_cast<std::size_t>(y) * finer.width + x];
        Bytes& all = coarser.texels[static_cast<std::size_t>(y / 2) * coarser.width + x / 2];
        all.low = std::min(all.low, texel.low);
        all.high = std::max(all.high, texel.high);
      }
    }
    levels_.push_back(std::move(coarser));
  }
}

AlphaRange AlphaPyramid::all() const {
  if (levels_.empty()) return {};
  const Bytes& all = levels_.back().texels.front();
  return {static_cast<float>(all.low) / 255.0f, static_cast<float>(all.high) / 255.0f};
}

AlphaRange AlphaPyramid::over(const glm::dvec2& low, const glm::dvec2& high,
                              const ImageSampling& sampling) const {
  if (levels_.empty()) return {};
  const glm::dvec2 size(levels_.front().width, levels_.front().height);
  // Filtered texels, and a little for what coordinates are rounded by.
  const double around = sampling.filter == ImageFilter::nearest ? 0.01 : 0.51;
  glm::ivec2 first, last;
  if (!inOnePeriod(low.x * size.x - around, high.x * size.x + around, levels_.front().width, sampling.wrapU,
                   first.x, last.x) ||
      !inOnePeriod(low.y * size.y - around, high.y * size.y + around, levels_.front().height, sampling.wrapV,
                   first.y, last.y))
    return all();
  return over(first, last);
}

AlphaRange AlphaPyramid::over(glm::ivec2 first, glm::ivec2 last) const {
  std::size_t level = 0;
  while (std::max(last.x - first.x, last.y - first.y) >= kMostTexels) first /= 2, last /= 2, ++level;
  Bytes found;
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      const Bytes& texel = levels_[level].texels[static_cast<std::size_t>(y) * levels_[level].width + x];
      found.low = std::min(found.low, texel.low);
      found.high = std::max(found.high, texel.high);
    }
  }
  return {static_cast<float>(found.low) / 255.0f, static_cast<float>(found.high) / 255.0f};
}

}  // namespace halfshadow::scene
