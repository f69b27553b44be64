// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "metrics/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace halfshadow::metrics {
namespace {

using Mask = std::vector<std::uint8_t>;
using Values = std::vector<float>;

TEST(Metrics, ByHand) {
  const Values measured{0.5f, 0.25f, 1.0f, 0.75f, 0.0f};
  const Values truth{0.25f, 0.5f, 1.0f, 0.25f, 1.0f};
  const ErrorStatistics s = errorStatistics(measured, truth, Mask{1, 1, 1, 1, 0});  // errors .25, -.25, 0, .5
  EXPECT_DOUBLE_EQ(s.mae, 0.25);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(0.375 / 4));
  EXPECT_DOUBLE_EQ(s.bias, 0.125);
  EXPECT_DOUBLE_EQ(s.max, 0.5);
  EXPECT_DOUBLE_EQ(s.p99, 0.5);
  EXPECT_DOUBLE_EQ(s.shareOver2Of255, 0.75);
  EXPECT_EQ(s.pixels, 4u);
  EXPECT_EQ(s.nanPixels, 0u);
}

TEST(Metrics, NothingSelectedGivesZeros) {
  const ErrorStatistics s = errorStatistics(Values{1.0f}, Values{0.0f}, Mask{0});
  EXPECT_EQ(s.pixels, 0u);
  EXPECT_EQ(s.mae + s.rmse + s.bias + s.p99 + s.max + s.shareOver2Of255, 0.0);
  EXPECT_EQ(errorStatistics({}, {}, {}).pixels, 0u);
}

TEST(Metrics, NinetyNinthPercentileIsTheNearestRank) {
  Values measured, truth(200, 0.0f);
  for (int i = 0; i < 200; ++i) measured.push_back(static_cast<float>(i % 2 ? i : -i) / 256.0f);
  // Rank 198 of 200 sizes 0 … 199: 197.
  EXPECT_DOUBLE_EQ(errorStatistics(measured, truth, Mask(200, 1)).p99, 197.0 / 256.0);
  EXPECT_DOUBLE_EQ(errorStatistics(measured, truth, Mask(200, 1)).max, 199.0 / 256.0);
}

TEST(Metrics, TwoSteppedPixelsAreNotOverTwoSteps) {
  for (int step = 0; step + 2 < 256; ++step) {
    const Values low{static_cast<float>(step) / 255.0f};
    const Values two{static_cast<float>(step + 2) / 255.0f};
    EXPECT_EQ(errorStatistics(two, low, Mask{1}).shareOver2Of255, 0.0) << step;
    const Values three{static_cast<float>(step + 3) / 255.0f};
    EXPECT_EQ(errorStatistics(three, low, Mask{1}).shareOver2Of255, 1.0) << step;
  }
}

TEST(Metrics, NanCountsAsAFullError) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const ErrorStatistics s =
      errorStatistics(Values{nan, infinity, 0.5f, 0.5f}, Values{1.0f, 0.25f, 0.5f, 0.5f},
                      Mask{1, 1, 1, 1});  // errors -1, 1, 0, 0
  EXPECT_EQ(s.nanPixels, 2u);
  EXPECT_EQ(s.pixels, 4u);
  EXPECT_DOUBLE_EQ(s.mae, 0.5);
  EXPECT_DOUBLE_EQ(s.bias, 0.0);
  EXPECT_DOUBLE_EQ(s.max, 1.0);
}

TEST(Metrics, WeightsAreRepeatedPixels) {
  const Values measured{0.1f, 0.9f, 0.4f, 0.7f}, truth{0.2f, 0.5f, 0.4f, 0.0f};
  const ErrorStatistics weighted = weightedErrorStatistics(measured, truth, Values{3.0f, 1.0f, 2.0f, 0.0f});
  const ErrorStatistics repeated = errorStatistics(Values{0.1f, 0.1f, 0.1f, 0.9f, 0.4f, 0.4f},
                                                   Values{0.2f, 0.2f, 0.2f, 0.5f, 0.4f, 0.4f}, Mask(6, 1));
  EXPECT_NEAR(weighted.mae, repeated.mae, 1e-12);
  EXPECT_NEAR(weighted.rmse, repeated.rmse, 1e-12);
  EXPECT_NEAR(weighted.bias, repeated.bias, 1e-12);
  EXPECT_NEAR(weighted.shareOver2Of255, repeated.shareOver2Of255, 1e-12);
  EXPECT_EQ(weighted.p99, repeated.p99);
  EXPECT_EQ(weighted.max, repeated.max);
  EXPECT_EQ(weighted.pixels, 3u) << "weight 0 deselects";
}

TEST(Metrics, RoughnessIsTheErrorsChangeAlongRows) {
  // Two rows of four; errors .25, .25, -.25, (left out) and .5, 0, 0, .5.
  const Values truth(8, 0.5f);
  const Values measured{0.75f, 0.75f, 0.25f, 0.0f, 1.0f, 0.5f, 0.5f, 1.0f};
  const Mask selected{1, 1, 1, 0, 1, 1, 1, 1};
  EXPECT_DOUBLE_EQ(roughness(measured, truth, selected, 4), std::sqrt((0.0 + 0.25 + 0.25 + 0.0 + 0.25) / 5));
  // The same offset everywhere is no roughness, whatever the truth does.
  EXPECT_DOUBLE_EQ(roughness(Values{0.25f, 0.75f, 0.5f}, Values{0.0f, 0.5f, 0.25f}, Mask{1, 1, 1}, 3), 0.0);
  EXPECT_EQ(roughness(measured, truth, Mask(8, 0), 4), 0.0);
  EXPECT_EQ(roughness({}, {}, {}, 4), 0.0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_DOUBLE_EQ(roughness(Values{nan, 0.0f}, Values{1.0f, 0.0f}, Mask{1, 1}, 2), 1.0);
}

TEST(Metrics, PenumbraIsStrictlyBetweenItsBounds) {
  const Values truth{0.0f, 0.005f, 0.0051f, 0.5f, 0.9949f, 0.995f, 1.0f, 0.5f};
  EXPECT_EQ(penumbraMask(truth, Mask{1, 1, 1, 2, 1, 1, 1, 0}), (Mask{0, 0, 1, 1, 1, 0, 0, 0}));
}

}  // namespace
}  // namespace halfshadow::metrics
