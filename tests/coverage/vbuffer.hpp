// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Forest's vBuffers: what of a quadrant of the light a caster occludes, and how two casters' parts combine.
/// Based on: Forest, Barthe, Paulin 2006, sections 3 and 4.3.
#pragma once

#include <cmath>

#include "coverage/edge_coverage.hpp"

namespace halfshadow::coverage {

/// Within a quadrant, in (u, v); empty by default.
template <typename T>
struct Bounds {
  T left = T(1), right = T(0), bottom = T(1), top = T(0);
  T area() const { return larger(right - left, T(0)) * larger(top - bottom, T(0)); }
  void include(T u, T v) {
    left = smaller(left, u), right = larger(right, u);
    bottom = smaller(bottom, v), top = larger(top, v);
  }
  void include(const Bounds& other) {
    left = smaller(left, other.left), right = larger(right, other.right);
    bottom = smaller(bottom, other.bottom), top = larger(top, other.top);
  }
};

template <typename T>
Bounds<T> intersection(const Bounds<T>& a, const Bounds<T>& b) {
  return {larger(a.left, b.left), smaller(a.right, b.right), larger(a.bottom, b.bottom),
          smaller(a.top, b.top)};
}

/// One quadrant of a vBuffer. Shares and areas are fractions of the quadrant.
template <typename T>
struct QuadrantOcclusion {
  T share = T(0);
  Bounds<T> bounds;
  T centreU = T(0.5), centreV = T(0.5);  ///< centre of gravity of what is occluded
};

/// Sums over the edges of one caster, all order-independent.
///
/// The paper keeps the largest x and y of the edges that end the shadow and shrinks the rectangle to them,
/// which fails where what remains reaches the light's border. The occluded lengths of the quadrant's two
/// outer sides take their place (two numbers as well): a side without any crossing is occluded as a whole or
/// not at all, and one with a crossing is already in the bounds, so the rectangle becomes exact.
template <typename T>
struct QuadrantSums {
  T taken = T(0);         ///< of the share, see quadrantContribution()
  Bounds<T> edges;        ///< of the edges' ends
  T takenRight = T(0);    ///< of the side u = 1
  T takenTop = T(0);      ///< of the side v = 1
  T takenMomentU = T(0);  ///< of the integral of u over what is occluded
  T takenMomentV = T(0);
};

/// Integrals of u and v over the part of the quadrant between its border, up to the border position `p`, and
/// its corner at the centre.
template <typename T>
T borderMomentU(T p) {
  const T past = smaller(p, T(1)), rest = T(2) - larger(p, T(1));
  return past / T(3) + (T(1) - rest * rest) / T(6);
}
template <typename T>
T borderMomentV(T p) {
  const T past = smaller(p, T(1));
  return past * past / T(6) + (larger(p, T(1)) - T(1)) / T(3);
}

template <typename T>
void addEdge(QuadrantSums<T>& sums, const QuadrantSegment<T>& p) {
  if (p.empty) return;
  const T from = quadrantPerimeter(p.u0, p.v0), to = quadrantPerimeter(p.u1, p.v1);
  const T turn(p.turn), twiceTriangle = p.u0 * p.v1 - p.v0 * p.u1;
  sums.taken = sums.taken + turn * (to - from - twiceTriangle) / T(2);
  sums.edges.include(p.u0, p.v0);
  sums.edges.include(p.u1, p.v1);
  sums.takenRight = sums.takenRight + turn * (smaller(to, T(1)) - smaller(from, T(1)));
  sums.takenTop = sums.takenTop + turn * (larger(to, T(1)) - larger(from, T(1)));
  const T weight = twiceTriangle / T(6);
  sums.takenMomentU =
      sums.takenMomentU + turn * (borderMomentU(to) - borderMomentU(from) - weight * (p.u0 + p.u1));
  sums.takenMomentV =
      sums.takenMomentV + turn * (borderMomentV(to) - borderMomentV(from) - weight * (p.v0 + p.v1));
}

/// `centreOccluded`: 1 where the light's centre is, else 0; the sums' share is repaired by the caller where H
/// is rasterised (repairQuadrants).
template <typename T>
QuadrantOcclusion<T> resolved(const QuadrantSums<T>& sums, T centreOccluded) {
  QuadrantOcclusion<T> result;
  result.share = clamped(centreOccluded - sums.taken, T(0), T(1));
  result.bounds = sums.edges;
  if (centreOccluded > T(0.5)) result.bounds.include(T(0), T(0));
  // Rounding cannot matter: where no edge crosses the side the length is 0 or 1.
  if (centreOccluded - sums.takenRight > T(0.5)) result.bounds.right = T(1);
  if (centreOccluded - sums.takenTop > T(0.5)) result.bounds.top = T(1);
  const T whole = centreOccluded / T(2), divisor = larger(result.share, T(1e-4));
  result.centreU =
      clamped((whole - sums.takenMomentU) / divisor, result.bounds.left, larger(result.bounds.right, T(0)));
  result.centreV =
      clamped((whole - sums.takenMomentV) / divisor, result.bounds.bottom, larger(result.bounds.top, T(0)));
  return result;
}

/// How what is occluded is spread along one side of its bounds: a density that rises evenly from end to end,
/// with mean 1 and the centre of gravity where it is. From (at middle - 1) to (at middle + 1) it runs from
/// 1 - slope to 1 + slope; beyond a third of the half side it would become negative.
template <typename T>
struct Spread {
  T middle, half, slope;
};
template <typename T>
Spread<T> spreadAlong(T low, T high, T centre) {
  const T half = larger((high - low) / T(2), T(1e-3));
  const T middle = (low + high) / T(2);
  return {middle, half, clamped(T(3) * (centre - middle) / half, T(-1), T(1))};
}
/// Integral over [low, high] of the product of two spreads, exactly (Simpson's rule of a parabola).
template <typename T>
T commonSpread(const Spread<T>& a, const Spread<T>& b, T low, T high) {
  if (!(low < high)) return T(0);
  const auto at = [&](T x) {
    return (T(1) + a.slope * (x - a.middle) / a.half) * (T(1) + b.slope * (x - b.middle) / b.half);
  };
  return (high - low) * (at(low) + T(4) * at((low + high) / T(2)) + at(high)) / T(6);
}

enum class Centres {
  ignored,  ///< the paper's method
  used      ///< its future work: centres of gravity
};

/// Two casters' parts of a quadrant: the areas added, less an estimate of what both occlude. Each is taken to
/// be spread over its bounds, never denser than solid: evenly, or rising evenly towards its centre of
/// gravity.
template <typename T>
QuadrantOcclusion<T> mergedQuadrant(const QuadrantOcclusion<T>& a, const QuadrantOcclusion<T>& b,
                                    Centres centres = Centres::ignored) {
  QuadrantOcclusion<T> result;
  result.bounds = a.bounds;
  result.bounds.include(b.bounds);
  const T tiny = smallestDivisor<T>();
  const T densityA = smaller(T(1), a.share / larger(a.bounds.area(), tiny));
  const T densityB = smaller(T(1), b.share / larger(b.bounds.area(), tiny));
  const Bounds<T> common = intersection(a.bounds, b.bounds);
  T overlap = densityA * densityB * common.area();
  if (centres == Centres::used) {
    const Bounds<T>&p = a.bounds, &q = b.bounds;
    const T spread = commonSpread(spreadAlong(p.left, p.right, a.centreU),
                                  spreadAlong(q.left, q.right, b.centreU), common.left, common.right) *
                     commonSpread(spreadAlong(p.bottom, p.top, a.centreV),
                                  spreadAlong(q.bottom, q.top, b.centreV), common.bottom, common.top);
    // Where both concentrate, more than evenly spread; never more than the rectangle.
    overlap = smaller(densityA * densityB * spread, common.area());
  }
  const T sum = a.share + b.share;
  result.share = clamped(sum - overlap, larger(a.share, b.share), smaller(T(1), sum));
  if (centres == Centres::used) {
    // What both occlude lies somewhere in the common rectangle: its middle, taken out once.
    const T twice = sum - result.share, divisor = larger(result.share, tiny);
    const auto centre = [&](T centreA, T centreB, T low, T high, T from, T to) {
      const T moment = a.share * centreA + b.share * centreB - twice * (low + high) / T(2);
      return clamped(moment / divisor, from, larger(from, to));
    };
    const Bounds<T>& r = result.bounds;
    result.centreU = centre(a.centreU, b.centreU, common.left, common.right, r.left, r.right);
    result.centreV = centre(a.centreV, b.centreV, common.bottom, common.top, r.bottom, r.top);
  }
  return result;
}

/// Two casters' shares as if each covered points of the light at random (Assarsson, Dougherty, Mounier,
/// Akenine-Möller 2003): the product of their visibilities.
template <typename T>
T mergedProbabilistic(T shareA, T shareB) {
  return T(1) - (T(1) - shareA) * (T(1) - shareB);
}

/// What an 8-bit channel keeps of a value in [0, 1].
template <typename T>
T storedNearest(T value) {
  using std::floor;
  return T(floor(static_cast<double>(value) * 255.0 + 0.5) / 255.0);
}
/// Rounded upwards: maxima stay bounds. What is already a multiple of 1/255 stays.
template <typename T>
T storedUpwards(T value) {
  using std::ceil;
  return T(ceil(static_cast<double>(value) * 255.0 - 1e-3) / 255.0);
}
/// Stored as (1 - left, right, 1 - bottom, top), each rounded upwards: MAX unites such rectangles.
template <typename T>
Bounds<T> storedBounds(const Bounds<T>& b) {
  return {T(1) - storedUpwards(T(1) - b.left), storedUpwards(b.right), T(1) - storedUpwards(T(1) - b.bottom),
          storedUpwards(b.top)};
}
template <typename T>
QuadrantOcclusion<T> stored(const QuadrantOcclusion<T>& q) {
  return {storedNearest(q.share), storedBounds(q.bounds), storedNearest(q.centreU), storedNearest(q.centreV)};
}

}  // namespace halfshadow::coverage
