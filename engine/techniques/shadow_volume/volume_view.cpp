// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_volume/volume_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace halfshadow::techniques {
namespace {
/// The far plane lies so far beyond infinity that rounding to float cannot cut what is drawn there.
constexpr double kInfinityMargin = 1.0 / (1 << 20);
/// Share by which the near rectangle is enlarged for the test: the rasteriser's own rounding.
constexpr double kNearMargin = 1e-3;

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};
Interval projected(std::span<const glm::dvec3> points, const glm::dvec3& axis) {
  Interval interval;
  for (const glm::dvec3& point : points) {
    const double at = glm::dot(point, axis);
    interval.low = std::min(interval.low, at);
    interval.high = std::max(interval.high, at);
  }
  return interval;
}

bool separates(const glm::dvec3& axis, std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  const Interval first = projected(a, axis), second = projected(b, axis);
  return first.high < second.low || second.high < first.low;
}

glm::dvec4 row(const glm::dmat4& m, int index) {
  return {m[0][index], m[1][index], m[2][index], m[3][index]};
}

void setRow(glm::dmat4& m, int index, const glm::dvec4& value) {
  for (int column = 0; column < 4; ++column) m[column][index] = value[column];
}
}  // namespace

VolumeView volumeView(const View& view) {
  VolumeView result{.clipFromWorld = view.clipFromWorld,
                    .eyeWorld = view.eyeWorld,
                    .nearReach = view.nearReach,
                    .width = view.width,
                    .height = view.height};
  // Of a perspective, z = a·w + b with b constant; at z = -w lies the near distance.
  const glm::dvec4 z = row(view.clipFromWorld, 2), w = row(view.clipFromWorld, 3);
  const double a = glm::dot(glm::dvec3(z), glm::dvec3(w)) / glm::dot(glm::dvec3(w), glm::dvec3(w));
  const double b = z.w - a * w.w;
  const double nearDistance = -b / (1.0 + a);
  setRow(result.clipFromWorld, 2,
         (1.0 - kInfinityMargin) * w - glm::dvec4(0, 0, 0, (2.0 - kInfinityMargin) * nearDistance));
  const glm::dmat4 worldFromClip = glm::inverse(view.clipFromWorld);
  constexpr std::array<glm::dvec2, 4> kCorners = {{{-1 - kNearMargin, -1 - kNearMargin},
                                                   {1 + kNearMargin, -1 - kNearMargin},
                                                   {1 + kNearMargin, 1 + kNearMargin},
                                                   {-1 - kNearMargin, 1 + kNearMargin}}};
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    const glm::dvec4 corner = worldFromClip * glm::dvec4(kCorners[i], -1.0, 1.0);
    result.nearCornersWorld[i] = glm::dvec3(corner) / corner.w;
  }
  return result;
}

BoxCorners boxCornersWorld(const glm::dmat4& worldFromObject, const scene::Bounds& boundsObject) {
  BoxCorners corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? boundsObject.high.x : boundsObject.low.x,
                            (i & 2) != 0 ? boundsObject.high.y : boundsObject.low.y,
                            (i & 4) != 0 ? boundsObject.high.z : boundsObject.low.z);
    corners[i] = glm::dvec3(worldFromObject * glm::dvec4(corner, 1.0));
  }
  return corners;
}

bool missesNearPyramid(const VolumeView& view, const glm::dvec3& lightWorld, const BoxCorners& boxWorld) {
  std::array<glm::dvec3, 5> pyramid{};
  for (std::size_t i = 0; i < 4; ++i) pyramid[i + 1] = view.nearCornersWorld[i] - lightWorld;
  BoxCorners box = boxWorld;
  for (glm::dvec3& corner : box) corner -= lightWorld;
  const std::array<glm::dvec3, 3> boxEdges = {box[1] - box[0], box[2] - box[0], box[4] - box[0]};
  const std::array<glm::dvec3, 6> pyramidEdges = {
      pyramid[1], pyramid[2], pyramid[3], pyramid[4], pyramid[2] - pyramid[1], pyramid[3] - pyramid[2]};
  const auto apart = [&](const glm::dvec3& axis) { return separates(axis, pyramid, box); };
  for (std::size_t i = 0; i < 4; ++i) {
    if (apart(glm::cross(pyramidEdges[i], pyramidEdges[(i + 1) % 4]))) return true;
  }
  if (apart(glm::cross(pyramidEdges[4], pyramidEdges[5]))) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (apart(glm::cross(boxEdges[i], boxEdges[(i + 1) % 3]))) return true;
    for (const glm::dvec3& edge : pyramidEdges) {
      if (apart(glm::cross(boxEdges[i], edge))) return true;
    }
  }
  return false;
}

std::optional<Rect> shadowScissor(const VolumeView& view, const glm::dvec3& lightWorld,
                                  const BoxCorners& boxWorld) {
  // The shadow lies in the hull of the corners and their directions from the light. Points of its part in
  // front of the near plane are bounded by the hull's vertices there and where its edges cut the plane; pairs
  // that are no edges cut it inside of the hull.
  std::array<glm::dvec4, 16> hull;
  scene::Bounds box;
  for (std::size_t i = 0; i < 8; ++i) {
    hull[i] = view.clipFromWorld * glm::dvec4(boxWorld[i], 1.0);
    hull[i + 8] = view.clipFromWorld * glm::dvec4(boxWorld[i] - lightWorld, 0.0);
    box.include(boxWorld[i]);
  }
  // A box around the light (or around the whole of its own bounds) shadows every direction.
  if (glm::all(glm::greaterThanEqual(lightWorld, box.low)) &&
      glm::all(glm::lessThanEqual(lightWorld, box.high)))
    return std::nullopt;
  const auto inFront = [](const glm::dvec4& p) { return p.z + p.w; };
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  const auto include = [&](const glm::dvec4& p) {
    const glm::dvec2 at = glm::dvec2(p) / std::max(p.w, 1e-300);
    low = glm::min(low, at);
    high = glm::max(high, at);
  };
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const double front = inFront(hull[i]);
    if (front > 0.0) include(hull[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const double other = inFront(hull[j]);
      if ((front > 0.0) == (other > 0.0)) continue;
      include(glm::mix(hull[i], hull[j], front / (front - other)));
    }
  }
  const glm::dvec2 size(view.width, view.height);
  const glm::dvec2 from = glm::clamp(glm::floor((low * 0.5 + 0.5) * size) - 1.0, glm::dvec2(0.0), size);
  const glm::dvec2 to = glm::clamp(glm::ceil((high * 0.5 + 0.5) * size) + 1.0, glm::dvec2(0.0), size);
  if (!(from.x < to.x && from.y < to.y)) return Rect{};
  if (from == glm::dvec2(0.0) && to == size) return std::nullopt;
  return Rect{static_cast<int>(from.x), static_cast<int>(from.y), static_cast<int>(to.x - from.x),
              static_cast<int>(to.y - from.y)};
}

}  // namespace halfshadow::techniques
