// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Random casters seen from random receivers, and the exact shares they occlude, by polygon clipping.
#pragma once

#include <random>
#include <vector>

#include "coverage/projection.hpp"

namespace halfshadow::test {

using Point = coverage::LightPoint<double>;
using Loop = std::vector<Point>;

struct Case {
  Point receiver{};
  std::vector<Loop> loops;  ///< counter-clockwise around what they occlude, holes clockwise
};

enum class Shape { convex, star, holed, crossing };

/// `lightScale`: how large the light is against the casters; the coordinates stay those of the light.
/// Shape::crossing: flat casters, some of whose vertices lie behind the receiver.
Case randomCase(std::mt19937& random, Shape shape, double lightScale = 1.0);

/// Exact share of the rectangle [left, left + width] × … that the case's casters occlude, each point counted
/// as often as the loops wind around it. long double.
double exactShare(const Case& c, double left = -1, double bottom = -1, double width = 2, double height = 2);

/// Loops as the receiver sees them, in any precision.
template <typename T>
std::vector<std::vector<coverage::Projected<T>>> projected(const Case& c) {
  std::vector<std::vector<coverage::Projected<T>>> result;
  const coverage::LightPoint<T> receiver{T(c.receiver.a), T(c.receiver.b), T(c.receiver.h)};
  for (const Loop& loop : c.loops) {
    auto& points = result.emplace_back();
    for (const Point& p : loop) {
      points.push_back(coverage::project<T>(receiver, {T(p.a), T(p.b), T(p.h)}));
    }
  }
  return result;
}

/// Calls `visit(q0, q1)` for each edge.
template <typename T, typename Visit>
void forEachEdge(const std::vector<std::vector<coverage::Projected<T>>>& loops, Visit visit) {
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
  }
}

/// 1 where the light's centre is occluded; loops are cut at w = `nearW` and closed there.
template <typename T>
int centreOccluded(const std::vector<std::vector<coverage::Projected<T>>>& loops, T nearW);

}  // namespace halfshadow::test
