// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/wedge_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfshadow::outlines {
namespace {
/// Of a clip coordinate w at the near plane: what can be divided by. It is a length of the host's, in units
/// of any size.
constexpr double kSmallestW = std::numeric_limits<double>::min();

Rect unitedRect(const Rect& a, const Rect& b) {
  const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}
}  // namespace

glm::dmat4 worldFromLight(const scene::LightPlane& plane) {
  return {glm::dvec4(plane.halfU, 0), glm::dvec4(plane.halfV, 0), glm::dvec4(plane.toUnitHeight, 0),
          glm::dvec4(plane.centerWorld, 1)};
}

glm::dmat4 worldFromAnchor(const scene::LightPlane& plane) {
  glm::dmat4 result = worldFromLight(plane);
  result[3] = glm::dvec4(plane.unitHeightWorld(), 1);
  return result;
}

bool reaches(const WedgeExtent& extent, const LightBox& box) {
  const double from = std::max(extent.nearest, box.low.z), to = box.high.z;
  if (from > to) return false;
  // Sides are linear in h: their extremes are at the ends.
  const glm::dvec2 low = glm::min(extent.low(from), extent.low(to));
  const glm::dvec2 high = glm::max(extent.high(from), extent.high(to));
  return low.x <= box.high.x && low.y <= box.high.y && high.x >= box.low.x && high.y >= box.low.y;
}

std::array<glm::dvec3, 8> volumeHull(const WedgeExtent& extent, double fromHeight, double toHeight) {
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const double h = i & 4 ? toHeight : fromHeight;
    const glm::dvec2 low = extent.low(h), high = extent.high(h);
    corners[static_cast<std::size_t>(i)] = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, h};
  }
  return corners;
}

std::optional<Rect> screenBounds(std::span<const glm::dvec3> points, const glm::dmat4& clipFromPoints,
                                 int width, int height) {
  std::vector<glm::dvec4> seen, hidden;
  for (const glm::dvec3& point : points) {
    const glm::dvec4 clip = clipFromPoints * glm::dvec4(point, 1.0);
    (clip.z + clip.w > 0.0 && clip.w > kSmallestW ? seen : hidden).push_back(clip);
  }
  const std::size_t whole = seen.size();
  for (std::size_t i = 0; i < whole; ++i) {
    for (const glm::dvec4& behind : hidden) {
      const double before = seen[i].z + seen[i].w, after = behind.z + behind.w;
      const double t = before > after ? std::clamp(before / (before - after), 0.0, 1.0) : 1.0;
      seen.push_back(glm::mix(seen[i], behind, t));
    }
  }
  if (seen.empty()) return std::nullopt;
  glm::dvec2 low(1e300), high(-1e300);
  const glm::dvec2 size(width, height);
  for (const glm::dvec4& clip : seen) {
    const glm::dvec2 window = (glm::dvec2(clip) / std::max(clip.w, kSmallestW) * 0.5 + 0.5) * size;
    low = glm::min(low, window), high = glm::max(high, window);
  }
  const glm::ivec2 first(glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0.0), size));
  const glm::ivec2 end(glm::clamp(glm::ceil(high) + 1.0, glm::dvec2(0.0), size));
  if (first.x >= end.x || first.y >= end.y) return std::nullopt;
  return Rect{first.x, first.y, end.x - first.x, end.y - first.y};
}

std::optional<Rect> commonRect(const Rect& a, const Rect& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  const int width = std::min(a.x + a.width, b.x + b.width) - x;
  const int height = std::min(a.y + a.height, b.y + b.height) - y;
  if (width <= 0 || height <= 0) return std::nullopt;
  return Rect{x, y, width, height};
}

std::vector<Rect> disjointRects(std::vector<Rect> rects) {
  std::vector<Rect> result;
  for (Rect rect : rects) {
    // What grows may meet others that it did not meet before.
    for (auto met = result.begin(); met != result.end();) {
      if (!commonRect(*met, rect)) {
        ++met;
        continue;
      }
      rect = unitedRect(*met, rect);
      result.erase(met);
      met = result.begin();
    }
    result.push_back(rect);
  }
  return result;
}

}  // namespace halfshadow::outlines
