// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "coverage/half_float.hpp"

#include <gtest/gtest.h>

namespace halfshadow::coverage {
namespace {

TEST(Half, RoundsToTheNearestEvenOfElevenBits) {
  EXPECT_EQ(roundToHalf(1.0f + 1.0f / 2048), 1.0f) << "a tie goes to the even neighbour";
  EXPECT_EQ(roundToHalf(1.0f + 3.0f / 2048), 1.0f + 4.0f / 2048);
  EXPECT_EQ(roundToHalf(1.0f + 1.1f / 2048), 1.0f + 2.0f / 2048);
  EXPECT_EQ(roundToHalf(-2049.0f), -2048.0f);
  EXPECT_EQ(roundToHalf(2051.0f), 2052.0f);
}

TEST(Half, OverflowsAndUnderflowsAsIeeeSays) {
  EXPECT_EQ(roundToHalf(65519.0f), 65504.0f);
  EXPECT_TRUE(std::isinf(roundToHalf(65520.0f)));
  const float smallest = std::ldexp(1.0f, -24);
  EXPECT_EQ(roundToHalf(smallest), smallest);
  EXPECT_EQ(roundToHalf(0.5f * smallest), 0.0f) << "a tie goes to zero";
  EXPECT_EQ(roundToHalf(-1.5f * smallest), -2 * smallest);
  EXPECT_EQ(roundToHalf(std::ldexp(1.0f, -14) * 0.99999f), std::ldexp(1.0f, -14));
  EXPECT_TRUE(std::isnan(roundToHalf(std::nanf(""))));
}

TEST(Half, KeepsAllEightBitFractions) {
  for (int i = 0; i <= 255; ++i) {
    const Half stored(static_cast<float>(i) / 255.0f);
    const Half decoded = stored * Half(255) + Half(0.5f);
    EXPECT_EQ(std::floor(static_cast<float>(decoded)), i);
  }
}

TEST(Half, RoundsEachOperation) {
  EXPECT_TRUE(Half(2048) + Half(1) == Half(2048));
  EXPECT_TRUE(Half(1) / Half(3) == Half(1.0f / 3.0f));
  EXPECT_TRUE(Half(300) * Half(300) > Half(65504.0f));
}

}  // namespace
}  // namespace halfshadow::coverage
