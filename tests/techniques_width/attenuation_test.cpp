// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The five properties that the paper demands of the attenuation (section 3), on a grid of both arguments.
#include "techniques/shadow_width/attenuation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace halfshadow::techniques {
namespace {

const Attenuation kConstants[] = {
    {.scale = 1.0, .bias = 0.05}, {.scale = 1.0, .bias = 0.0}, {.scale = 12.0, .bias = 0.05}};
constexpr int kSteps = 64;
double argument(int step) {
  return static_cast<double>(step) / kSteps;
}

TEST(Attenuation, IsOneWhereTheLightIsSeen) {
  for (const Attenuation& constants : kConstants) {
    for (int i = 0; i <= kSteps; ++i) {
      EXPECT_EQ(attenuation(0.0, argument(i), constants), 1.0);
      EXPECT_EQ(attenuation(argument(i), 0.0, constants), 1.0);
    }
  }
}

TEST(Attenuation, DependsOnTheRatioOnly) {
  for (const Attenuation& constants : kConstants) {
    for (int i = 1; i <= kSteps; ++i) {
      for (const double zoom : {0.125, 0.5, 3.0}) {
        // Two roundings of a quotient and a product.
        EXPECT_NEAR(attenuation(argument(i), 0.25, constants),
                    attenuation(zoom * argument(i), zoom * 0.25, constants), 1e-12);
      }
    }
  }
}

TEST(Attenuation, FallsStrictlyWithWidthUntilItIsZero) {
  for (const Attenuation& constants : kConstants) {
    for (int i = 1; i <= kSteps; ++i) {
      for (int j = 1; j < kSteps; ++j) {
        const double nearer = attenuation(argument(i), argument(j), constants);
        const double deeper = attenuation(argument(i), argument(j + 1), constants);
        EXPECT_LE(deeper, nearer);
        // Up to 1 the bias holds the value at its clamp.
        if (nearer > 0.0 && nearer < 1.0) {
          EXPECT_LT(deeper, nearer);
        }
        if (nearer == 0.0) {
          EXPECT_EQ(deeper, 0.0);
        }
      }
    }
  }
}

TEST(Attenuation, IsContinuousAwayFromContact) {
  for (const Attenuation& constants : kConstants) {
    for (int i = 1; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        constexpr double kStep = 1e-6;
        const double depth = argument(i), width = argument(j);
        // The slope is at most scale / depth in width, and width / depth times that in depth.
        const double slope = constants.scale * (1.0 + width / depth) / depth;
        EXPECT_NEAR(attenuation(depth, width, constants), attenuation(depth, width + kStep, constants),
                    1.01 * slope * kStep + 1e-12);
        EXPECT_NEAR(attenuation(depth, width, constants), attenuation(depth + kStep, width, constants),
                    1.01 * slope * kStep + 1e-12);
      }
    }
  }
}

TEST(Attenuation, SharpensTowardsTheOccluder) {
  for (const Attenuation& constants : kConstants) {
    for (int i = 1; i < kSteps; ++i) {
      for (int j = 1; j <= kSteps; ++j) {
        const double nearer = attenuation(argument(i), argument(j), constants);
        const double farther = attenuation(argument(i + 1), argument(j), constants);
        EXPECT_LE(nearer, farther);
        if (farther > 0.0 && farther < 1.0) {
          EXPECT_LT(nearer, farther);
        }
      }
    }
  }
}

TEST(Attenuation, TheTableHoldsTheFunction) {
  const Attenuation constants{.scale = 2.0, .bias = 0.05};
  const std::vector<std::uint8_t> table = attenuationTable(constants);
  ASSERT_EQ(table.size(), static_cast<std::size_t>(kAttenuationSide) * kAttenuationSide);
  for (int row = 0; row < kAttenuationSide; row += 5) {
    for (int column = 0; column < kAttenuationSide; column += 3) {
      const double byte = table[static_cast<std::size_t>(row * kAttenuationSide + column)];
      // Half a step: rounding to 8 bits.
      EXPECT_NEAR(byte / 255.0, attenuation(column / 255.0, row / 255.0, constants), 0.5 / 255.0 + 1e-12);
    }
  }
}

}  // namespace
}  // namespace halfshadow::techniques
