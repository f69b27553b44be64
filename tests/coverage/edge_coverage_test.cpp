// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Occluded share of the whole light, by edge sums and by the trapezoid integral, against polygon clipping.
#include "coverage/edge_coverage.hpp"

#include <gtest/gtest.h>

#include "coverage/trapezoid.hpp"
#include "random_loops.hpp"

namespace halfshadow::test {
namespace {
using coverage::Half;

constexpr Shape kBetween[] = {Shape::convex, Shape::star, Shape::holed};
constexpr Shape kAll[] = {Shape::convex, Shape::star, Shape::holed, Shape::crossing};
constexpr int kCasesPerShape = 30'000;  // 120,000 in all

/// The segment in another precision: clipped in the first, measured in the second.
template <typename To, typename From>
coverage::Segment<To> in(const coverage::Segment<From>& s) {
  if constexpr (std::is_same_v<To, From>) {
    return s;
  } else {
    return {To(float(s.x0)), To(float(s.y0)), To(float(s.x1)), To(float(s.y1)), s.empty};
  }
}

/// H minus the edges' sum: projected and clipped in `Clip`, areas and their sum in `Area`.
template <typename Area, typename Clip>
double edgeSumShare(const Case& c, int centre) {
  Area sum(0);
  forEachEdge<Clip>(projected<Clip>(c), [&](const auto& q0, const auto& q1) {
    sum = sum + coverage::edgeContribution(in<Area>(coverage::clipToLight(q0, q1)));
  });
  return static_cast<double>(Area(centre) - sum);
}

double trapezoidShare(const Case& c, double left, double bottom, double width, double height) {
  double sum = 0;
  std::vector<coverage::FlatPoint<double>> flat;
  for (const auto& loop : projected<double>(c)) {
    coverage::clipNear<double>(loop, 1e-6, flat);
    sum += coverage::loopCoverage<double>(flat, {left, bottom, width, height});
  }
  return sum;
}

int exactCentre(const Case& c) {
  return centreOccluded<double>(projected<double>(c), 1e-9);
}

struct Errors {
  double worst = 0, squares = 0;
  int count = 0;
  void add(double error) {
    worst = std::max(worst, std::isnan(error) ? 1e9 : std::abs(error));
    squares += error * error;
    ++count;
  }
  double rms() const { return std::sqrt(squares / std::max(count, 1)); }
};

/// `share(c)` against the truth.
template <typename Share>
Errors errorsOf(std::span<const Shape> shapes, double lightScale, int cases, Share share) {
  Errors errors;
  std::mt19937 random(7);
  for (const Shape shape : shapes) {
    for (int i = 0; i < cases; ++i) {
      const Case c = randomCase(random, shape, lightScale);
      errors.add(share(c) - exactShare(c));
    }
  }
  return errors;
}

TEST(EdgeCoverage, InDoubleIsExact) {
  const Errors errors = errorsOf(kAll, 1.0, kCasesPerShape, [](const Case& c) {
    return edgeSumShare<double, double>(c, exactCentre(c));
  });
  EXPECT_EQ(errors.count, 120'000);
  // Up to 72 edges, each with some ten roundings of 1e-16 of a light 8 units around.
  EXPECT_LE(errors.worst, 3e-14);
}

TEST(EdgeCoverage, InFloatIsFarBelowEightBits) {
  const auto share = [](const Case& c) {
    return coverage::repairedShare(edgeSumShare<float, float>(c, exactCentre(c)));
  };
  EXPECT_LE(errorsOf(kBetween, 1.0, kCasesPerShape, share).worst, 1.2e-5);
  // An edge through the receiver's height projects to infinity: a hundred light sizes are common, and its
  // clipped end keeps the rounding of the far one. Measured 1.8e-5.
  const Shape crossing[] = {Shape::crossing};
  EXPECT_LE(errorsOf(crossing, 1.0, kCasesPerShape, share).worst, 4e-5);
}

TEST(EdgeCoverage, AreasInHalfStayBelowEightBits) {
  const Errors errors = errorsOf(kAll, 1.0, kCasesPerShape, [](const Case& c) {
    return coverage::repairedShare(edgeSumShare<Half, float>(c, exactCentre(c)));
  });
  // Border positions up to 7 have steps of 1/256, an eighth of which is 5e-4 of the light; measured 1.5e-4.
  EXPECT_LE(errors.rms(), 2.8e-4);
  EXPECT_LE(errors.worst, 6e-3);
}

TEST(EdgeCoverage, TheTrapezoidIntegralIsExactForAnyCell) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1, 0.7), size(0.1, 1.0);
  Errors errors;
  for (const Shape shape : kAll) {
    for (int i = 0; i < kCasesPerShape; ++i) {
      const Case c = randomCase(random, shape);
      const double left = place(random), bottom = place(random), width = size(random), height = size(random);
      errors.add(trapezoidShare(c, left, bottom, width, height) - exactShare(c, left, bottom, width, height));
    }
  }
  // The near cut at 1e-6 leaves coordinates of 1e6 light sizes, whose slopes cost digits.
  EXPECT_LE(errors.worst, 1e-9);
}

TEST(EdgeCoverage, TinyAndHugeLights) {
  // Casters of 1e4 light sizes, seen by one receiver in a hundred as more than all or nothing, and of 1e-3.
  for (const double scale : {1e-4, 1e3}) {
    const Errors exact = errorsOf(kBetween, scale, 3'000, [](const Case& c) {
      return edgeSumShare<double, double>(c, exactCentre(c));
    });
    EXPECT_LE(exact.worst, 3e-12) << scale;
    const Errors errors = errorsOf(kBetween, scale, 3'000, [](const Case& c) {
      return coverage::repairedShare(edgeSumShare<float, float>(c, exactCentre(c)));
    });
    // A vertex at 4e4 has steps of 4e-3 of the light in fp32.
    EXPECT_LE(errors.worst, scale < 1 ? 2e-2 : 1e-4) << scale;
    const Errors half = errorsOf(kBetween, scale, 3'000, [](const Case& c) {
      return coverage::repairedShare(edgeSumShare<Half, float>(c, exactCentre(c)));
    });
    EXPECT_LE(half.worst, scale < 1 ? 2e-2 : 6e-3) << scale << ": clipped in fp32 nothing overflows";
  }
}

/// A square caster half way to the receiver above the light's centre, with one edge or vertex exactly on the
/// line from the receiver to the light's centre.
Case squareAt(double left, double bottom, double side) {
  Case c;
  c.receiver = {0, 0, 1};
  c.loops = {{{left, bottom, 0.5},
              {left + side, bottom, 0.5},
              {left + side, bottom + side, 0.5},
              {left, bottom + side, 0.5}}};
  return c;
}

TEST(EdgeCoverage, TheLightsCentreOnAnEdgeOrVertexIsRepaired) {
  const Case cases[] = {squareAt(0, -0.1, 0.25),     squareAt(0, 0, 0.3),     squareAt(-0.3, -0.3, 0.3),
                        squareAt(-0.25, -0.1, 0.25), squareAt(-0.1, 0, 0.25), squareAt(-0.1, -0.25, 0.25)};
  int wrong = 0;
  for (const Case& c : cases) {
    const double truth = exactShare(c);
    ASSERT_GT(truth, 0.02);
    // A rasterised H may say either.
    for (const int centre : {0, 1}) {
      const double sum = edgeSumShare<float, float>(c, centre), half = edgeSumShare<Half, float>(c, centre);
      wrong += std::abs(sum - truth) > 0.5 ? 1 : 0;
      EXPECT_NEAR(coverage::repairedShare(sum), truth, 1e-5);
      EXPECT_NEAR(coverage::repairedShare(half), truth, 4e-3);
    }
  }
  EXPECT_GT(wrong, 0) << "else the repair was not needed";
}

TEST(EdgeCoverage, AnEdgeParallelToTheRayIsHarmless) {
  // Two vertices on one ray through the receiver: the edge projects to a point.
  for (const double x : {-1.0, -0.3, 0.0, 0.4, 1.0}) {
    Case c;
    c.receiver = {0.5, -0.25, 1};
    const auto at = [&](double px, double h) { return Point{px * (1 - h) + 0.5 * h, -0.25 * h, h}; };
    c.loops = {{at(x, 0.25), at(x, 0.5), {2, -2, 0.25}, {2, 2, 0.25}}};
    const double truth = exactShare(c);
    const int centre = exactCentre(c);
    EXPECT_NEAR((coverage::repairedShare(edgeSumShare<double, double>(c, centre))), truth, 1e-12);
    EXPECT_NEAR((coverage::repairedShare(edgeSumShare<float, float>(c, centre))), truth, 1e-5);
    EXPECT_NEAR((coverage::repairedShare(edgeSumShare<Half, float>(c, centre))), truth, 4e-3);
  }
}

TEST(EdgeCoverage, AnEdgeThroughTheReceiverGivesANumber) {
  const coverage::Projected<float> nothing{0, 0, 0}, beside{0.25f, 0.5f, 1}, behind{-0.5f, 0.25f, -1};
  for (const auto& other : {nothing, beside, behind}) {
    EXPECT_FALSE(std::isnan(coverage::edgeContribution(coverage::clipToLight(nothing, other))));
    EXPECT_FALSE(std::isnan(coverage::edgeContribution(coverage::clipToLight(other, nothing))));
  }
}

}  // namespace
}  // namespace halfshadow::test
