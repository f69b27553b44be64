// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "metrics/metrics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace halfshadow::metrics {
namespace {

constexpr double kTwoOf255 =
    2.0 / 255.0 + 1e-6;  // 1e-6: an exact difference of two 8-bit steps is not "over"

double errorOf(float measured, float truth) {
  if (!std::isfinite(measured)) return truth >= 0.5f ? -1.0 : 1.0;
  return static_cast<double>(measured) - static_cast<double>(truth);
}

struct WeightedError {
  double size, weight;
};

class Accumulator {
 public:
  explicit Accumulator(std::size_t expectedPixels) { sizes_.reserve(expectedPixels); }

  void add(float measured, float truth, double weight) {
    const double error = errorOf(measured, truth);
    if (!std::isfinite(measured)) ++result_.nanPixels;
    const double size = std::abs(error);
    result_.mae += weight * size;
    result_.rmse += weight * error * error;
    result_.bias += weight * error;
    result_.max = std::max(result_.max, size);
    if (size > kTwoOf255) result_.shareOver2Of255 += weight;
    weightSum_ += weight;
    sizes_.push_back({size, weight});
  }

  ErrorStatistics finished() {
    result_.pixels = sizes_.size();
    if (sizes_.empty()) return result_;
    result_.mae /= weightSum_;
    result_.rmse = std::sqrt(result_.rmse / weightSum_);
    result_.bias /= weightSum_;
    result_.shareOver2Of255 /= weightSum_;
    result_.p99 = quantile(0.99);
    return result_;
  }

 private:
  double quantile(double share) {
    std::sort(sizes_.begin(), sizes_.end(),
              [](const WeightedError& a, const WeightedError& b) { return a.size < b.size; });
    // 1e-9: 0.99 · n summed in floating point must not miss the rank that it equals exactly.
    const double wanted = (share - 1e-9) * weightSum_;
    double reached = 0;
    for (const WeightedError& error : sizes_) {
      reached += error.weight;
      if (reached >= wanted) return error.size;
    }
    return sizes_.back().size;
  }

  ErrorStatistics result_;
  double weightSum_ = 0;
  std::vector<WeightedError> sizes_;
};

}  // namespace

ErrorStatistics errorStatistics(std::span<const float> measured, std::span<const float> truth,
                                std::span<const std::uint8_t> selected) {
  assert(measured.size() == truth.size() && measured.size() == selected.size());
  Accumulator accumulator(selected.size());
  for (std::size_t i = 0; i < selected.size(); ++i) {
    if (selected[i]) accumulator.add(measured[i], truth[i], 1.0);
  }
  return accumulator.finished();
}

ErrorStatistics weightedErrorStatistics(std::span<const float> measured, std::span<const float> truth,
                                        std::span<const float> weights) {
  assert(measured.size() == truth.size() && measured.size() == weights.size());
  Accumulator accumulator(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0.0f) accumulator.add(measured[i], truth[i], weights[i]);
  }
  return accumulator.finished();
}

double roughness(std::span<const float> measured, std::span<const float> truth,
                 std::span<const std::uint8_t> selected, std::size_t width) {
  assert(measured.size() == truth.size() && measured.size() == selected.size() && width > 0);
  double sum = 0;
  std::size_t pairs = 0;
  for (std::size_t i = 1; i < selected.size(); ++i) {
    if (i % width == 0 || !selected[i] || !selected[i - 1]) continue;
    const double difference = errorOf(measured[i], truth[i]) - errorOf(measured[i - 1], truth[i - 1]);
    sum += difference * difference;
    ++pairs;
  }
  return pairs > 0 ? std::sqrt(sum / static_cast<double>(pairs)) : 0.0;
}

std::vector<std::uint8_t> penumbraMask(std::span<const float> truth, std::span<const std::uint8_t> receiver) {
  assert(truth.size() == receiver.size());
  std::vector<std::uint8_t> mask(truth.size());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    mask[i] = receiver[i] != 0 && truth[i] > kPenumbraLow && truth[i] < kPenumbraHigh;
  }
  return mask;
}

}  // namespace halfshadow::metrics
