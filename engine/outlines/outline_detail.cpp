// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/outline_detail.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::outlines {
namespace {
/// Of the light, whose half sides are 1.
constexpr double kLightArea = 4.0;

struct Receivers {
  glm::vec3 middle{0.0f}, half{0.0f};
  float iHigh = 0.0f;
  explicit Receivers(const TangentBox& box)
      : middle(0.5f * (glm::vec3(box.tLow, box.iLow) + glm::vec3(box.tHigh, box.iHigh))),
        half(0.5f * (glm::vec3(box.tHigh, box.iHigh) - glm::vec3(box.tLow, box.iLow))),
        iHigh(box.iHigh) {}
  bool behind(std::span<const glm::vec3> loop) const {
    return std::ranges::all_of(loop, [this](const glm::vec3& p) { return p.z > iHigh; });
  }
};

/// What lies between two edges and the one that replaces them, on the light.
struct Area {
  float middle = 0.0f;  ///< signed, for a receiver in the middle as high as the highest
  float most = 0.0f;    ///< for none of them it is larger
};

/// A point p is seen from r on the light at (p - r).xy / (p - r).z, so that a triangle's area there is half
/// the determinant of its corners less r, over the product of their heights: of r the determinant is linear.
Area areaBetween(const glm::vec3& a, const glm::vec3& left, const glm::vec3& b, const Receivers& receivers) {
  const glm::vec3 normal = glm::cross(left - a, b - a);
  const float middle = glm::dot(normal, a - receivers.middle);
  const float spread = glm::dot(glm::abs(normal), receivers.half);
  const float heights = (a.z - receivers.iHigh) * (left.z - receivers.iHigh) * (b.z - receivers.iHigh);
  return {0.5f * middle / heights, 0.5f * (std::abs(middle) + spread) / heights};
}
}  // namespace

void dropDetail(CasterLoops& loops, const TangentBox& box, double mostShare) {
  if (!(mostShare > 0.0)) return;
  const Receivers receivers(box);
  // A stretch is between two places that have each gained or lost as much.
  const auto most = static_cast<float>(0.5 * kLightArea * mostShare);
  std::uint32_t kept = 0;
  for (CasterLoops::Loop& loop : loops.loops) {
    const std::span<const glm::vec3> points = std::span(loops.points).subspan(loop.first, loop.count);
    const bool whole = loop.oneSided || !receivers.behind(points);
    const glm::vec3 start = points.front();
    glm::vec3 last = start;  // kept
    loop.first = kept;
    loops.points[kept++] = start;
    // Both since the loop began, and since the last vertex that was kept.
    float gained = 0.0f, changed = 0.0f;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const glm::vec3 point = points[k], next = k + 1 == points.size() ? start : points[k + 1];
      if (!whole) {
        const Area area = areaBetween(last, point, next, receivers);
        if (changed + area.most <= most && std::abs(gained + area.middle) <= most) {
          changed += area.most;
          gained += area.middle;
          continue;
        }
      }
      loops.points[kept++] = last = point;
      changed = 0.0f;
    }
    loop.count = kept - loop.first;
  }
  loops.points.resize(kept);
  std::erase_if(loops.loops, [](const CasterLoops::Loop& loop) { return loop.count < 3; });
}

}  // namespace halfshadow::outlines
