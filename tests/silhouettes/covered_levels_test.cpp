// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What loops cover once, twice, …, against turns around single points.
#include "scene/covered_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {
using scene::CoveredLevels;
using Points = std::vector<glm::dvec3>;

struct Placed {
  Points points;
  std::uint32_t surface = 0;
  CoveredLevels::Side side = CoveredLevels::Side::towards;
};

glm::dvec2 flat(const glm::dvec3& p, const glm::dvec2& source) {
  return (glm::dvec2(p) - source) / p.z;
}

/// Turns of a loop around a point, by angles: nothing that the code under test does.
int turns(const Points& loop, const glm::dvec2& at, const glm::dvec2& source) {
  double angle = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const glm::dvec2 a = flat(loop[k], source) - at, b = flat(loop[(k + 1) % loop.size()], source) - at;
    angle += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return static_cast<int>(std::lround(angle / (2.0 * std::numbers::pi)));
}

double distanceTo(const Points& loop, const glm::dvec2& at, const glm::dvec2& source) {
  double least = 1e300;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const glm::dvec2 a = flat(loop[k], source), b = flat(loop[(k + 1) % loop.size()], source) - a;
    const double t = std::clamp(glm::dot(at - a, b) / std::max(glm::dot(b, b), 1e-300), 0.0, 1.0);
    least = std::min(least, glm::length(at - a - t * b));
  }
  return least;
}

/// The larger of both sides, summed over surfaces.
int levelAt(const std::vector<Placed>& loops, const glm::dvec2& at, const glm::dvec2& source) {
  std::map<std::uint32_t, std::array<int, 2>> counts;
  for (const Placed& loop : loops)
    counts[loop.surface][static_cast<std::size_t>(loop.side)] += turns(loop.points, at, source);
  int level = 0;
  for (const auto& [surface, sides] : counts) level += std::max({0, sides[0], sides[1]});
  return level;
}

void expectLevels(const std::vector<Placed>& loops, const glm::dvec2& source, unsigned seed) {
  CoveredLevels covered;
  covered.start(source);
  for (const Placed& loop : loops) covered.addLoop(loop.points, loop.surface, loop.side);
  std::vector<CoveredLevels::Level> levels;
  ASSERT_TRUE(covered.find(levels)) << "seed " << seed;
  Random random(seed);
  for (int probe = 0; probe < 300; ++probe) {
    const glm::dvec2 at(random.between(-2.5, 2.5), random.between(-2.5, 2.5));
    double nearest = 1e300;
    for (const Placed& loop : loops) nearest = std::min(nearest, distanceTo(loop.points, at, source));
    if (nearest < 1e-6) continue;
    const int expected = levelAt(loops, at, source);
    for (int level = 1; level <= static_cast<int>(levels.size()) + 1; ++level) {
      int found = 0;
      if (level <= static_cast<int>(levels.size())) {
        for (const CoveredLevels::Loop& loop : levels[static_cast<std::size_t>(level) - 1])
          found += turns(loop.points, at, source);
      }
      EXPECT_EQ(found, expected >= level ? 1 : 0) << "seed " << seed << ", level " << level;
    }
  }
}

Points square(const glm::dvec2& middle, double half, double height) {
  Points points;
  for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    points.emplace_back((middle + half * corner) * height, height);
  return points;
}

Points star(Random& random, int corners) {
  Points points;
  const glm::dvec2 middle(random.between(-1, 1), random.between(-1, 1));
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / corners, radius = random.between(0.2, 1.2),
                 height = random.between(0.5, 4.0);
    points.emplace_back((middle + radius * glm::dvec2(std::cos(angle), std::sin(angle))) * height, height);
  }
  return points;
}

TEST(CoveredLevels, OfOneLoopAreTheLoop) {
  CoveredLevels covered;
  covered.start(glm::dvec2(0.0));
  covered.addLoop(square({0, 0}, 1, 2), 0, CoveredLevels::Side::towards);
  std::vector<CoveredLevels::Level> levels;
  ASSERT_TRUE(covered.find(levels));
  ASSERT_EQ(levels.size(), 1u);
  ASSERT_EQ(levels[0].size(), 1u);
  EXPECT_EQ(levels[0][0].points.size(), 4u);
  EXPECT_NEAR(levels[0][0].area, 4.0, 1e-8);
}

TEST(CoveredLevels, StepAlongRaysWhereEdgesCross) {
  CoveredLevels covered;
  covered.start(glm::dvec2(0.0));
  covered.addLoop(square({0, 0}, 1, 1), 0, CoveredLevels::Side::towards);
  covered.addLoop(square({1, 1}, 1, 3), 1, CoveredLevels::Side::towards);
  std::vector<CoveredLevels::Level> levels;
  ASSERT_TRUE(covered.find(levels));
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_NEAR(levels[0][0].area, 7.0, 1e-8);
  EXPECT_NEAR(levels[1][0].area, 1.0, 1e-8);
  // Three corners of each, and at both crossings a point of either.
  EXPECT_EQ(levels[0][0].points.size(), 10u);
  for (const glm::dvec3& p : levels[0][0].points)
    EXPECT_TRUE(std::abs(p.z - 1.0) < 1e-12 || std::abs(p.z - 3.0) < 1e-12);
}

// A shell whose underside has a hole: its outline covers once, and the hole is hidden by the upper side.
TEST(CoveredLevels, CountOneSurfaceOnceWhereItsSidesLieOverEachOther) {
  Points hole = square({0, 0}, 0.4, 2);
  std::ranges::reverse(hole);
  std::vector<Placed> loops{{square({0, 0}, 1, 1.5), 0, CoveredLevels::Side::towards},
                            {square({0, 0}, 1, 1.5), 0, CoveredLevels::Side::away},
                            {hole, 0, CoveredLevels::Side::away}};
  expectLevels(loops, glm::dvec2(0.0), 1);
  loops[1].surface = loops[2].surface = 1;
  expectLevels(loops, glm::dvec2(0.0), 2);
}

// Edges that lie over each other, vertices on edges and vertices that meet: what files are full of.
TEST(CoveredLevels, AreRightWhereLoopsTouch) {
  expectLevels({{square({0, 0}, 1, 1)}, {square({2, 0}, 1, 1), 1}}, glm::dvec2(0.0), 3);
  expectLevels({{square({0, 0}, 1, 1)}, {square({0, 0}, 1, 1), 1}}, glm::dvec2(0.0), 4);
  expectLevels({{square({0, 0}, 1, 1)}, {square({0.5, 0}, 0.5, 1), 1}}, glm::dvec2(0.0), 5);
  expectLevels({{square({0, 0}, 1, 1)}, {square({1, 1}, 1, 1), 1}, {square({1, -1}, 1, 1), 2}},
               glm::dvec2(0.0), 6);
}

TEST(CoveredLevels, OfManyLoopsAreThoseOfTheirTurns) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    std::vector<Placed> loops;
    const int count = 1 + static_cast<int>(seed % 7);
    for (int k = 0; k < count; ++k) {
      const auto side = random.between(0, 1) < 0.3 ? CoveredLevels::Side::away : CoveredLevels::Side::towards;
      loops.push_back({star(random, 3 + static_cast<int>(random.between(0, 12))),
                       static_cast<std::uint32_t>(random.between(0, 3)), side});
    }
    expectLevels(loops, {random.between(-0.5, 0.5), random.between(-0.5, 0.5)}, seed);
  }
}

}  // namespace
}  // namespace halfshadow::testing
