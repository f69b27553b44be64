// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Occluded shares of quadrants and of their cells against polygon clipping.
#include <gtest/gtest.h>

#include "coverage/edge_coverage.hpp"
#include "coverage/half_float.hpp"
#include "coverage/vbuffer.hpp"
#include "random_loops.hpp"

namespace halfshadow::test {
namespace {
using coverage::Half;

constexpr Shape kAll[] = {Shape::convex, Shape::star, Shape::holed, Shape::crossing};
constexpr int kCasesPerShape = 8'000;

/// Quadrant shares of the part of the light with half sides (halfX, halfY).
template <typename Area, typename Clip>
std::array<Area, 4> quadrantShares(const Case& c, double halfX, double halfY) {
  std::array<Area, 4> shares;
  shares.fill(Area(centreOccluded<double>(projected<double>(c), 1e-9)));
  forEachEdge<Clip>(projected<Clip>(c), [&](const auto& q0, const auto& q1) {
    const auto s = coverage::clipToLight(coverage::scaled(q0, Clip(halfX), Clip(halfY)),
                                         coverage::scaled(q1, Clip(halfX), Clip(halfY)));
    const coverage::Segment<Area> segment{Area(s.x0), Area(s.y0), Area(s.x1), Area(s.y1), s.empty};
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
      shares[quadrant] =
          shares[quadrant] - coverage::quadrantContribution(coverage::clipToQuadrant(segment, quadrant));
    }
  });
  return shares;
}

double exactQuadrant(const Case& c, int quadrant, double u0, double v0, double width, double height) {
  const double left = coverage::kQuadrantX[quadrant] > 0 ? u0 : -u0 - width;
  const double bottom = coverage::kQuadrantY[quadrant] > 0 ? v0 : -v0 - height;
  return exactShare(c, left, bottom, width, height);
}

TEST(Quadrants, AreExactInDoubleAndSmallInHalf) {
  std::mt19937 random(3);
  double worst = 0, worstFloat = 0, squaresHalf = 0;
  int count = 0, grazed = 0;
  for (const Shape shape : kAll) {
    for (int i = 0; i < kCasesPerShape; ++i) {
      const Case c = randomCase(random, shape);
      const auto shares = quadrantShares<double, double>(c, 1, 1);
      auto floats = quadrantShares<float, float>(c, 1, 1);
      auto halves = quadrantShares<Half, float>(c, 1, 1);
      coverage::repairQuadrants(floats);
      coverage::repairQuadrants(halves);
      for (int quadrant = 0; quadrant < 4; ++quadrant) {
        const double truth = exactQuadrant(c, quadrant, 0, 0, 1, 1);
        worst = std::max(worst, std::abs(shares[quadrant] - truth));
        worstFloat = std::max(worstFloat, std::abs(floats[quadrant] - truth));
        const double half = static_cast<double>(halves[quadrant]) - truth;
        // An edge within fp16's steps of the centre may leave the quadrant it grazed.
        if (std::abs(half) > 0.02) {
          ++grazed;
          continue;
        }
        squaresHalf += half * half;
        ++count;
      }
    }
  }
  // Four times the bounds of the whole light: a quadrant is a quarter of it.
  EXPECT_LE(worst, 1.2e-13);
  EXPECT_LE(worstFloat, 1.6e-4);
  EXPECT_LE(std::sqrt(squaresHalf / count), 1.1e-3);
  EXPECT_LE(grazed, count / 10'000);
}

TEST(Quadrants, NestedRectanglesGiveCells) {
  std::mt19937 random(5);
  double worst = 0, squares8 = 0;
  int count = 0;
  for (const Shape shape : kAll) {
    for (int i = 0; i < kCasesPerShape / 4; ++i) {
      const Case c = randomCase(random, shape);
      const auto whole = quadrantShares<double, double>(c, 1, 1);
      const auto narrow = quadrantShares<double, double>(c, 0.5, 1);
      const auto low = quadrantShares<double, double>(c, 1, 0.5);
      const auto both = quadrantShares<double, double>(c, 0.5, 0.5);
      for (int quadrant = 0; quadrant < 4; ++quadrant) {
        const auto cells =
            coverage::cellShares(whole[quadrant], narrow[quadrant], low[quadrant], both[quadrant]);
        const auto stored = coverage::cellShares(
            coverage::storedNearest(whole[quadrant]), coverage::storedNearest(narrow[quadrant]),
            coverage::storedNearest(low[quadrant]), coverage::storedNearest(both[quadrant]));
        const double truths[] = {
            exactQuadrant(c, quadrant, 0, 0, 0.5, 0.5), exactQuadrant(c, quadrant, 0.5, 0, 0.5, 0.5),
            exactQuadrant(c, quadrant, 0, 0.5, 0.5, 0.5), exactQuadrant(c, quadrant, 0.5, 0.5, 0.5, 0.5)};
        const double exact[] = {cells.inner, cells.right, cells.upper, cells.outer};
        const double bytes[] = {stored.inner, stored.right, stored.upper, stored.outer};
        for (int k = 0; k < 4; ++k) {
          worst = std::max(worst, std::abs(exact[k] - truths[k]));
          const double error = bytes[k] - truths[k];
          EXPECT_LE(std::abs(error), 9.0 * 0.5 / 255) << "the outer cell sums 4 + 2 + 2 + 1 roundings";
          squares8 += error * error;
          ++count;
        }
      }
    }
  }
  EXPECT_LE(worst, 1e-12);
  EXPECT_LE(std::sqrt(squares8 / count), 0.0025);
}

}  // namespace
}  // namespace halfshadow::test
