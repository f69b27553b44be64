// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What one silhouette edge adds to the occluded share of the light: of the whole, per quadrant, per cell.
/// Based on: Akenine-Möller, Assarsson 2002 and Forest, Barthe, Paulin 2006, section 4.2 (area between edge
/// and light border, integrated around the light's centre), with the border measured by its perimeter
/// instead of a texture.
#pragma once

#include <array>

#include "coverage/projection.hpp"

namespace halfshadow::coverage {

/// Where the ray from the centre through (x, y) meets the border of [-1, 1]²: border length from (1, 0),
/// counter-clockwise, in [-1, 7].
template <typename T>
T perimeter(T x, T y) {
  if (absolute(x) >= absolute(y)) {
    const T ratio = y / (x < T(0) ? smaller(x, -smallestDivisor<T>()) : larger(x, smallestDivisor<T>()));
    return x < T(0) ? T(4) + ratio : ratio;
  }
  const T ratio = x / y;
  return y > T(0) ? T(2) - ratio : T(6) - ratio;
}

/// The shorter way round the border, whose length is 8.
template <typename T>
T wrappedPerimeter(T difference) {
  if (difference > T(4)) return difference - T(8);
  if (difference < T(-4)) return difference + T(8);
  return difference;
}

/// Share of the light between the edge and the border; positive where what is occluded lies on the centre's
/// side (counter-clockwise loops). The occluded share is H minus the sum over all edges, H = 1 where the
/// light's centre is occluded.
template <typename T>
T edgeContribution(const Segment<T>& s) {
  if (s.empty) return T(0);
  const T around = wrappedPerimeter(perimeter(s.x1, s.y1) - perimeter(s.x0, s.y0));
  return (around - (s.x0 * s.y1 - s.y0 * s.x1)) / T(8);
}

/// +1 or -1 where the edge crosses the positive x axis of the light's plane from below or from above, else 0.
/// Their sum over closed loops with w > 0 tells whether the centre is occluded, with exactly the comparisons
/// that the contributions depend on.
template <typename T>
int centreCrossing(const Projected<T>& q0, const Projected<T>& q1) {
  const bool below0 = q0.y < T(0), below1 = q1.y < T(0);
  if (below0 == below1) return 0;
  const T turn = q0.x * q1.y - q0.y * q1.x;
  if (below0) return turn > T(0) ? 1 : 0;
  return turn < T(0) ? -1 : 0;
}

/// Rasterised H and the arithmetic may disagree where an edge crosses the centre: then the sum is off by
/// exactly one. Valid for one closed caster (whose true share is in [0, 1]); clamped afterwards.
template <typename T>
T repairedShare(T share) {
  if (share > T(1.02)) share = share - T(1);
  if (share < T(-0.02)) share = share + T(1);
  return clamped(share, T(0), T(1));
}

// Quadrants are numbered counter-clockwise from (+, +); u = |x|, v = |y|. Signs of x and y:
inline constexpr std::array<int, 4> kQuadrantX{1, -1, -1, 1};
inline constexpr std::array<int, 4> kQuadrantY{1, 1, -1, -1};

/// An edge's part in one quadrant. `turn` is -1 where the quadrant mirrors the orientation.
template <typename T>
struct QuadrantSegment {
  T u0 = T(0), v0 = T(0), u1 = T(0), v1 = T(0);
  int turn = 1;
  bool empty = true;
};

template <typename T>
QuadrantSegment<T> clipToQuadrant(const Segment<T>& s, int quadrant) {
  QuadrantSegment<T> part;
  if (s.empty) return part;
  const T sx = T(kQuadrantX[quadrant]), sy = T(kQuadrantY[quadrant]);
  const T u0 = sx * s.x0, v0 = sy * s.y0, u1 = sx * s.x1, v1 = sy * s.y1;
  T enter(0), leave(0);
  cutBehind<T>(u0, u1, enter, leave);
  cutBehind<T>(v0, v1, enter, leave);
  if (!(enter + leave < T(1))) return part;
  part.u0 = clamped(u0 + enter * (u1 - u0), T(0), T(1));
  part.v0 = clamped(v0 + enter * (v1 - v0), T(0), T(1));
  part.u1 = clamped(u1 + leave * (u0 - u1), T(0), T(1));
  part.v1 = clamped(v1 + leave * (v0 - v1), T(0), T(1));
  part.turn = kQuadrantX[quadrant] * kQuadrantY[quadrant];
  part.empty = false;
  return part;
}

/// Border length from (1, 0) over (1, 1) to (0, 1), in [0, 2], where the ray through (u, v) meets it.
template <typename T>
T quadrantPerimeter(T u, T v) {
  const T ratio = smaller(u, v) / larger(larger(u, v), smallestDivisor<T>());
  return u >= v ? ratio : T(2) - ratio;
}

/// As edgeContribution(), as a share of the quadrant: the occluded share of the quadrant is H minus the sum.
template <typename T>
T quadrantContribution(const QuadrantSegment<T>& p) {
  if (p.empty) return T(0);
  const T around = quadrantPerimeter(p.u1, p.v1) - quadrantPerimeter(p.u0, p.v0);
  return T(p.turn) * (around - (p.u0 * p.v1 - p.v0 * p.u1)) / T(2);
}

/// repairedShare() for the four quadrants of one caster: a wrong H shows in every quadrant at once.
template <typename T>
void repairQuadrants(std::array<T, 4>& shares) {
  const T least = smaller(smaller(shares[0], shares[1]), smaller(shares[2], shares[3]));
  const T most = larger(larger(shares[0], shares[1]), larger(shares[2], shares[3]));
  T shift(0);
  if (most > T(1.02)) shift = T(-1);
  if (least < T(-0.02)) shift = T(1);
  for (T& share : shares) share = clamped(share + shift, T(0), T(1));
}

/// A quadrant cut in the middle of both sides.
template <typename T>
struct CellShares {
  T inner, right, upper, outer;  ///< cells at (u, v) low/low, high/low, low/high, high/high
};

/// Cells from nested rectangles: occluded shares of [0, 1]², [0, ½]×[0, 1], [0, 1]×[0, ½] and [0, ½]².
template <typename T>
CellShares<T> cellShares(T whole, T halfWidth, T halfHeight, T halfBoth) {
  const T two(2);
  return {halfBoth, two * halfHeight - halfBoth, two * halfWidth - halfBoth,
          two * (two * whole - halfWidth - halfHeight) + halfBoth};
}

}  // namespace halfshadow::coverage
