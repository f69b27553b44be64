// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A silhouette edge seen from a receiver: projected onto the light's plane and clipped to the light.
#pragma once

#include <span>
#include <vector>

#include "coverage/half_float.hpp"

namespace halfshadow::coverage {

/// In the coordinates of scene::LightPlane: the light is the square [-1, 1]² at h = 0, receivers at h > 0.
template <typename T>
struct LightPoint {
  T a, b, h;
};

/// The point (x, y) / w of the light's plane. w > 0: the edge lies between the receiver and the light.
template <typename T>
struct Projected {
  T x, y, w;
};

/// Where the ray from `receiver` through `edge` meets the light's plane. Linear in each of the two. Written
/// with the difference of the two, which is exact where they are close: receivers next to their caster.
template <typename T>
Projected<T> project(const LightPoint<T>& receiver, const LightPoint<T>& edge) {
  const T w = receiver.h - edge.h;
  return {receiver.h * (edge.a - receiver.a) + w * receiver.a,
          receiver.h * (edge.b - receiver.b) + w * receiver.b, w};
}

/// The same for the part of the light whose half sides are `halfX`, `halfY`, as if it were the whole.
template <typename T>
Projected<T> scaled(const Projected<T>& q, T halfX, T halfY) {
  return {q.x / halfX, q.y / halfY, q.w};
}

/// A part of a projected edge inside the light, in [-1, 1]².
template <typename T>
struct Segment {
  T x0 = T(0), y0 = T(0), x1 = T(0), y1 = T(0);
  bool empty = true;
};

/// How much to cut off both ends of a segment on which a plane's distance runs from d0 to d1: grows `enter`
/// and `leave`, fractions from the first and the last end. Nothing is left where enter + leave >= 1.
template <typename T>
void cutBehind(T d0, T d1, T& enter, T& leave) {
  const T length = larger(absolute(d1 - d0), smallestDivisor<T>());
  enter = larger(enter, larger(-d0, T(0)) / length);
  leave = larger(leave, larger(-d1, T(0)) / length);
}

/// Clips to |x| <= w, |y| <= w, which implies w >= 0 (the papers' local near plane), then divides.
/// Based on: Liang, Barsky, "A New Concept and Method for Line Clipping", 1984.
template <typename T>
Segment<T> clipToLight(const Projected<T>& q0, const Projected<T>& q1) {
  T enter(0), leave(0);
  cutBehind<T>(q0.w + q0.x, q1.w + q1.x, enter, leave);
  cutBehind<T>(q0.w - q0.x, q1.w - q1.x, enter, leave);
  cutBehind<T>(q0.w + q0.y, q1.w + q1.y, enter, leave);
  cutBehind<T>(q0.w - q0.y, q1.w - q1.y, enter, leave);
  if (!(enter + leave < T(1))) return {};
  const T w0 = larger(q0.w + enter * (q1.w - q0.w), smallestDivisor<T>());
  const T w1 = larger(q1.w + leave * (q0.w - q1.w), smallestDivisor<T>());
  Segment<T> segment;
  segment.x0 = clamped((q0.x + enter * (q1.x - q0.x)) / w0, T(-1), T(1));
  segment.y0 = clamped((q0.y + enter * (q1.y - q0.y)) / w0, T(-1), T(1));
  segment.x1 = clamped((q1.x + leave * (q0.x - q1.x)) / w1, T(-1), T(1));
  segment.y1 = clamped((q1.y + leave * (q0.y - q1.y)) / w1, T(-1), T(1));
  segment.empty = false;
  return segment;
}

/// A closed loop with what lies behind the receiver cut off at w = nearW and the cut ends joined by chords,
/// divided: `nearW` > 0, small against the light's size. Replaces the content of `result` (empty when all
/// of it lies behind).
template <typename T>
struct FlatPoint {
  T x, y;
};
template <typename T>
void clipNear(std::span<const Projected<T>> loop, T nearW, std::vector<FlatPoint<T>>& result) {
  result.clear();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Projected<T>& q0 = loop[i];
    const Projected<T>& q1 = loop[i + 1 < loop.size() ? i + 1 : 0];
    const T d0 = q0.w - nearW, d1 = q1.w - nearW;
    if (d0 >= T(0)) result.push_back({q0.x / q0.w, q0.y / q0.w});
    if ((d0 < T(0)) != (d1 < T(0))) {
      const T t = d0 / (d0 - d1);
      result.push_back({(q0.x + t * (q1.x - q0.x)) / nearW, (q0.y + t * (q1.y - q0.y)) / nearW});
    }
  }
}

}  // namespace halfshadow::coverage
