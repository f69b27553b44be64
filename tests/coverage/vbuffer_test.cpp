// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Forest's vBuffers: bounding rectangles against brute force, merges against what two casters can do.
#include "coverage/vbuffer.hpp"

#include <gtest/gtest.h>

#include "random_loops.hpp"

namespace halfshadow::test {
namespace {
using coverage::Bounds;
using coverage::QuadrantOcclusion;

std::array<coverage::QuadrantSums<double>, 4> quadrantSums(const Case& c) {
  std::array<coverage::QuadrantSums<double>, 4> sums;
  forEachEdge<double>(projected<double>(c), [&](const auto& q0, const auto& q1) {
    const auto segment = coverage::clipToLight(q0, q1);
    for (int k = 0; k < 4; ++k) coverage::addEdge(sums[k], coverage::clipToQuadrant(segment, k));
  });
  return sums;
}

/// Share of the strip u in [u0, u1], v in [v0, v1] of a quadrant.
double strip(const Case& c, int quadrant, double u0, double u1, double v0, double v1) {
  const double left = coverage::kQuadrantX[quadrant] > 0 ? u0 : -u1;
  const double bottom = coverage::kQuadrantY[quadrant] > 0 ? v0 : -v1;
  return exactShare(c, left, bottom, u1 - u0, v1 - v0);
}

TEST(VBuffer, RectanglesBoundWhatIsOccludedTightly) {
  std::mt19937 random(21);
  constexpr double kThin = 1e-4, kNothing = 1e-9;
  int partial = 0, whole = 0, empty = 0;
  for (const Shape shape : {Shape::convex, Shape::star, Shape::holed}) {
    for (int i = 0; i < 2'000; ++i) {
      const Case c = randomCase(random, shape);
      const int centre = centreOccluded<double>(projected<double>(c), 1e-9);
      const auto sums = quadrantSums(c);
      for (int k = 0; k < 4; ++k) {
        const QuadrantOcclusion<double> q = coverage::resolved(sums[k], double(centre));
        EXPECT_NEAR(q.share, strip(c, k, 0, 1, 0, 1), 1e-12);
        const Bounds<double>& b = q.bounds;
        if (q.share < kNothing) {
          ++empty;
          continue;
        }
        (b.area() > 1 - kNothing ? whole : partial) += 1;
        // Nothing outside …
        if (b.left > kThin) {
          EXPECT_LE(strip(c, k, 0, b.left, 0, 1), kNothing);
        }
        if (b.right < 1 - kThin) {
          EXPECT_LE(strip(c, k, b.right, 1, 0, 1), kNothing);
        }
        if (b.bottom > kThin) {
          EXPECT_LE(strip(c, k, 0, 1, 0, b.bottom), kNothing);
        }
        if (b.top < 1 - kThin) {
          EXPECT_LE(strip(c, k, 0, 1, b.top, 1), kNothing);
        }
        // … and something along each side. (A caster with a hole that reaches no further than this
        // quadrant's border has its bounds from an edge of the hole only where the border is occluded.)
        const double inside = std::min({kThin, b.right - b.left, b.top - b.bottom});
        if (shape != Shape::holed && inside > 1e-6) {
          EXPECT_GT(strip(c, k, b.left, b.left + inside, 0, 1), 0) << i << ' ' << k;
          EXPECT_GT(strip(c, k, b.right - inside, b.right, 0, 1), 0) << i << ' ' << k;
          EXPECT_GT(strip(c, k, 0, 1, b.bottom, b.bottom + inside), 0) << i << ' ' << k;
          EXPECT_GT(strip(c, k, 0, 1, b.top - inside, b.top), 0) << i << ' ' << k;
        }
      }
    }
  }
  EXPECT_GT(partial, 1'000);
  EXPECT_GT(whole, 200);
  EXPECT_GT(empty, 1'000);
}

TEST(VBuffer, EightBitsRoundRectanglesOutward) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 10'000; ++i) {
    Bounds<double> b;
    b.include(unit(random), unit(random));
    b.include(unit(random), unit(random));
    const Bounds<double> kept = coverage::storedBounds(b);
    constexpr double kSlack = 1e-3 / 255 + 1e-12;  // so that what is stored already stays
    EXPECT_LE(kept.left, b.left + kSlack);
    EXPECT_LE(kept.bottom, b.bottom + kSlack);
    EXPECT_GE(kept.right, b.right - kSlack);
    EXPECT_GE(kept.top, b.top - kSlack);
    EXPECT_LE(kept.right - b.right, 1.0 / 255);
    EXPECT_LE(b.left - kept.left, 1.0 / 255);
    const Bounds<double> again = coverage::storedBounds(kept);
    EXPECT_NEAR(again.left, kept.left, 1e-12);
    EXPECT_NEAR(again.right, kept.right, 1e-12);
  }
}

QuadrantOcclusion<double> solid(double left, double right, double bottom, double top) {
  QuadrantOcclusion<double> q;
  q.bounds = {left, right, bottom, top};
  q.share = q.bounds.area();
  return q;
}

TEST(VBuffer, SolidRectanglesMergeExactly) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> low(0, 0.6), side(0.05, 0.4);
  for (int i = 0; i < 10'000; ++i) {
    const double u = low(random), v = low(random), s = low(random), t = low(random);
    const auto a = solid(u, u + side(random), v, v + side(random));
    const auto b = solid(s, s + side(random), t, t + side(random));
    const double both = coverage::intersection(a.bounds, b.bounds).area();
    EXPECT_NEAR(coverage::mergedQuadrant(a, b).share, a.share + b.share - both, 1e-12);
    EXPECT_NEAR(coverage::mergedQuadrant(b, a).share, a.share + b.share - both, 1e-12);
  }
}

TEST(VBuffer, MergesStayBetweenFullAndNoOverlap) {
  std::mt19937 random(17);
  for (int i = 0; i < 5'000; ++i) {
    const Case ca = randomCase(random, Shape::star), cb = randomCase(random, Shape::star);
    const auto sumsA = quadrantSums(ca), sumsB = quadrantSums(cb);
    for (int k = 0; k < 4; ++k) {
      const auto a =
          coverage::resolved(sumsA[k], double(centreOccluded<double>(projected<double>(ca), 1e-9)));
      const auto b =
          coverage::resolved(sumsB[k], double(centreOccluded<double>(projected<double>(cb), 1e-9)));
      const double merged = coverage::mergedQuadrant(a, b).share;
      EXPECT_GE(merged, std::max(a.share, b.share));
      EXPECT_LE(merged, std::min(1.0, a.share + b.share));
      EXPECT_NEAR(coverage::mergedQuadrant(a, {}).share, a.share, 1e-12)
          << "nothing to merge changes nothing";
      const double product = coverage::mergedProbabilistic(a.share, b.share);
      EXPECT_GE(product, std::max(a.share, b.share) - 1e-12);
      EXPECT_LE(product, std::min(1.0, a.share + b.share) + 1e-12);
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
