// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "random_loops.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coverage/edge_coverage.hpp"

namespace halfshadow::test {
namespace {

/// Casters and receivers are fp32 numbers, so that errors are those of the arithmetic alone.
Point inFloat(double a, double b, double h) {
  return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(h)};
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

struct Flat {
  double x, y;
};

/// Star-shaped around (0, 0), counter-clockwise; convex when `jagged` is 0.
std::vector<Flat> outline(std::mt19937& random, double radius, double jagged) {
  const int count = std::uniform_int_distribution<int>(4, 24)(random);
  const double squash = uniform(random, 0.2, 1.0), tilt = uniform(random, 0, std::numbers::pi);
  std::vector<double> angles(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    angles[static_cast<std::size_t>(i)] = (i + uniform(random, 0.0, 0.8)) * 2 * std::numbers::pi / count;
  }
  std::vector<Flat> points;
  for (const double angle : angles) {
    const double r = radius * (1.0 - jagged * uniform(random, 0, 1));
    const double x = r * std::cos(angle), y = r * squash * std::sin(angle);
    points.push_back({x * std::cos(tilt) - y * std::sin(tilt), x * std::sin(tilt) + y * std::cos(tilt)});
  }
  return points;
}

using Exact = coverage::Projected<long double>;

std::vector<Exact> clipped(const std::vector<Exact>& loop, long double x, long double y, long double w) {
  const auto distance = [&](const Exact& q) { return x * q.x + y * q.y + w * q.w; };
  std::vector<Exact> result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Exact &q0 = loop[i], &q1 = loop[(i + 1) % loop.size()];
    const long double d0 = distance(q0), d1 = distance(q1);
    if (d0 >= 0) result.push_back(q0);
    if ((d0 < 0) != (d1 < 0)) {
      const long double t = d0 / (d0 - d1);
      result.push_back({q0.x + t * (q1.x - q0.x), q0.y + t * (q1.y - q0.y), q0.w + t * (q1.w - q0.w)});
    }
  }
  return result;
}

}  // namespace

Case randomCase(std::mt19937& random, Shape shape, double lightScale) {
  Case c;
  const double radius = std::pow(10.0, uniform(random, -1.0, 0.5)) / lightScale;
  const double far = 1.0 + radius;
  const Flat centre{uniform(random, -far, far), uniform(random, -far, far)};
  c.receiver = inFloat(uniform(random, -4, 4) / lightScale, uniform(random, -4, 4) / lightScale, 1.0);
  std::vector<std::vector<Flat>> outlines{outline(random, radius, shape == Shape::convex ? 0.0 : 0.8)};
  if (shape == Shape::holed) {
    std::vector<Flat> hole = outlines[0];
    for (Flat& p : hole) p = {0.6 * p.x, 0.6 * p.y};
    std::reverse(hole.begin(), hole.end());
    outlines.push_back(hole);
    // A second caster elsewhere in the same silhouette.
    outlines.push_back(outline(random, radius / 2, 0.5));
    for (Flat& p : outlines.back()) p.x += 2 * radius;
  }
  if (shape == Shape::crossing) {
    // A flat caster tilted through the receiver's height.
    const double slopeA = uniform(random, -0.5, 0.5) / radius, slopeB = uniform(random, -0.5, 0.5) / radius;
    Loop& loop = c.loops.emplace_back();
    const double a = c.receiver.a + uniform(random, -2, 2) * radius;
    const double b = c.receiver.b + uniform(random, -2, 2) * radius;
    for (const Flat& p : outlines[0]) {
      loop.push_back(inFloat(a + p.x, b + p.y, std::max(0.02, 1.0 + slopeA * p.x + slopeB * p.y)));
    }
    // The receiver may see the other side.
    if (exactShare(c) < 0) std::reverse(loop.begin(), loop.end());
    return c;
  }
  // Placed so that the projection meets the light; vertices at different heights.
  const double height = uniform(random, 0.1, 0.8);
  for (const std::vector<Flat>& flat : outlines) {
    Loop& loop = c.loops.emplace_back();
    for (const Flat& p : flat) {
      const double h = height + uniform(random, -0.08, 0.08);
      loop.push_back(inFloat((centre.x + p.x) * (1 - h) + c.receiver.a * h,
                             (centre.y + p.y) * (1 - h) + c.receiver.b * h, h));
    }
  }
  return c;
}

double exactShare(const Case& c, double left, double bottom, double width, double height) {
  long double twiceArea = 0;
  for (const std::vector<Exact>& loop : projected<long double>(c)) {
    std::vector<Exact> part = clipped(loop, 1, 0, -left);
    part = clipped(part, -1, 0, left + width);
    part = clipped(part, 0, 1, -bottom);
    part = clipped(part, 0, -1, bottom + height);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Exact &p = part[i], &q = part[(i + 1) % part.size()];
      twiceArea += (p.x * q.y - p.y * q.x) / (p.w * q.w);
    }
  }
  return static_cast<double>(twiceArea / 2 / (static_cast<long double>(width) * height));
}

template <typename T>
int centreOccluded(const std::vector<std::vector<coverage::Projected<T>>>& loops, T nearW) {
  int winding = 0;
  for (const auto& loop : loops) {
    std::vector<coverage::Projected<T>> part;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto &q0 = loop[i], &q1 = loop[(i + 1) % loop.size()];
      const T d0 = q0.w - nearW, d1 = q1.w - nearW;
      if (d0 >= T(0)) part.push_back(q0);
      if ((d0 < T(0)) != (d1 < T(0))) {
        const T t = d0 / (d0 - d1);
        part.push_back({q0.x + t * (q1.x - q0.x), q0.y + t * (q1.y - q0.y), nearW});
      }
    }
    for (std::size_t i = 0; i < part.size(); ++i) {
      winding += coverage::centreCrossing(part[i], part[(i + 1) % part.size()]);
    }
  }
  return winding;
}
template int centreOccluded(const std::vector<std::vector<coverage::Projected<double>>>&, double);
template int centreOccluded(const std::vector<std::vector<coverage::Projected<float>>>&, float);

}  // namespace halfshadow::test
