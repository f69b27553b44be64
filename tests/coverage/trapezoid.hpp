// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Occluded share of any rectangle of the light by a closed loop, as the integral of clamp(x, 0, 1) dy: no
/// light-centre bit, no quadrants, no wrap.
#pragma once

#include <span>

#include "coverage/projection.hpp"

namespace halfshadow::coverage {

/// A rectangle of the light's plane, sides > 0.
template <typename T>
struct Cell {
  T left, bottom, width, height;
};

/// Mean of clamp(x, 0, 1) while x runs evenly from x0 to x1.
template <typename T>
T meanClamped(T x0, T x1) {
  const T inside0 = clamped(x0, T(0), T(1)), inside1 = clamped(x1, T(0), T(1));
  const T middle = (inside0 + inside1) / T(2);
  const T run = x1 - x0;
  // Both ends on one side of each bound: the mean is that of the clamped ends, and the quotient below would
  // divide rounding errors by a short run.
  if (inside0 == x0 && inside1 == x1) return middle;
  if (absolute(run) < smallestDivisor<T>()) return middle;
  const T full = larger(x1, T(1)) - larger(x0, T(1));
  return clamped(((inside1 - inside0) * middle + full) / run, T(0), T(1));
}

/// Share of `cell` between its left side and the part of the edge at its height, signed by the edge's
/// direction: upward edges count positive.
template <typename T>
T trapezoid(const FlatPoint<T>& p0, const FlatPoint<T>& p1, const Cell<T>& cell) {
  const T y0 = (p0.y - cell.bottom) / cell.height, y1 = (p1.y - cell.bottom) / cell.height;
  const T inside0 = clamped(y0, T(0), T(1)), inside1 = clamped(y1, T(0), T(1));
  const T height = inside1 - inside0;
  if (height == T(0)) return T(0);
  const T x0 = (p0.x - cell.left) / cell.width, x1 = (p1.x - cell.left) / cell.width;
  const T slope = (x1 - x0) / (y1 - y0);
  const T from = inside0 == y0 ? x0 : x0 + (inside0 - y0) * slope;
  const T to = inside1 == y1 ? x1 : x1 + (inside1 - y1) * slope;
  return height * meanClamped(from, to);
}

/// Mean of clamp(x, 0, 1)² / 2 while x runs evenly from x0 to x1: the integral of x over what lies left of an
/// edge.
template <typename T>
T meanClampedMoment(T x0, T x1) {
  const T inside0 = clamped(x0, T(0), T(1)), inside1 = clamped(x1, T(0), T(1));
  const T run = x1 - x0;
  if ((inside0 == x0 && inside1 == x1) || absolute(run) < smallestDivisor<T>())
    return (inside0 * inside0 + inside0 * inside1 + inside1 * inside1) / T(6);
  const auto primitive = [](T x, T c) { return c * c * (c / T(6) + (x - c) / T(2)); };
  return clamped((primitive(x1, inside1) - primitive(x0, inside0)) / run, T(0), T(0.5));
}

/// Share of `cell` inside the counter-clockwise loop (minus it, when clockwise), each point counted as often
/// as the loop winds around it.
template <typename T>
T loopCoverage(std::span<const FlatPoint<T>> loop, const Cell<T>& cell) {
  T sum(0);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    sum = sum + trapezoid(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0], cell);
  }
  return sum;
}

}  // namespace halfshadow::coverage
