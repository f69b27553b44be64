// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Errors between two visibility images. Every image is a row-major list of one float per pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace halfshadow::metrics {

/// A truth strictly between these is penumbra.
inline constexpr float kPenumbraLow = 0.005f;
inline constexpr float kPenumbraHigh = 0.995f;

/// Statistics of error = measured - truth over the selected pixels. All zero when nothing is selected.
struct ErrorStatistics {
  double mae = 0;   ///< mean of |error|
  double rmse = 0;  ///< root of the mean of error²
  double bias = 0;  ///< mean of error; positive = measured is too bright
  double p99 = 0;   ///< smallest e so that at least 99 % of the pixels have |error| <= e
  double max = 0;   ///< largest |error|
  double shareOver2Of255 =
      0;  ///< share, 0 … 1, of pixels with |error| > 2/255 (by more than 1e-6, float rounding)
  std::size_t pixels = 0;     ///< selected pixels (with weights: those of positive weight)
  std::size_t nanPixels = 0;  ///< of those, pixels whose measured value is NaN or infinite
};

/// Compares pixel by pixel where `selected` is not 0. The three spans have the same length.
/// A measured value that is NaN or infinite counts as an error of size 1, away from the nearer of 0 and 1:
/// -1 where the truth is at least a half, else +1. The truth is finite.
ErrorStatistics errorStatistics(std::span<const float> measured, std::span<const float> truth,
                                std::span<const std::uint8_t> selected);

/// The same with a weight per pixel: mae, rmse, bias and shareOver2Of255 are weighted means, p99 is the
/// weighted quantile, max is over pixels of positive weight. A weight that is not positive (or NaN) deselects
/// its pixel.
ErrorStatistics weightedErrorStatistics(std::span<const float> measured, std::span<const float> truth,
                                        std::span<const float> weights);

/// How uneven an error is from pixel to pixel: root of the mean square of its difference between neighbours
/// in a row, over all pairs whose pixels are both selected; 0 without pairs. A smooth error counts little,
/// rings and single specks of the same size count whole. Spans as above, in rows of `width` pixels; what is
/// NaN or infinite counts as above.
double roughness(std::span<const float> measured, std::span<const float> truth,
                 std::span<const std::uint8_t> selected, std::size_t width);

/// 1 where `receiver` is not 0 and kPenumbraLow < truth < kPenumbraHigh, else 0. Same length for both spans.
std::vector<std::uint8_t> penumbraMask(std::span<const float> truth, std::span<const std::uint8_t> receiver);

}  // namespace halfshadow::metrics
