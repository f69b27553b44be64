// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/poisson_disc.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>

namespace halfshadow::techniques {
namespace {
/// xorshift: the same stream on every platform, unlike the standard distributions.
float nextUnit(std::uint32_t& state) {
  state ^= state << 13;
  state ^= state >> 17;
  state ^= state << 5;
  return static_cast<float>(state >> 8) * (1.0f / 16777216.0f);
}
}  // namespace

std::vector<glm::vec2> poissonDisc(int count) {
  std::uint32_t state = 0x9e3779b9u;
  std::vector<glm::vec2> points;
  while (static_cast<int>(points.size()) < count) {
    glm::vec2 best(0.0f);
    float bestDistance = -1.0f;
    const int candidates = 40 + 20 * static_cast<int>(points.size());
    for (int i = 0; i < candidates; ++i) {
      const glm::vec2 candidate(2.0f * nextUnit(state) - 1.0f, 2.0f * nextUnit(state) - 1.0f);
      if (glm::dot(candidate, candidate) > 1.0f) continue;
      float nearest = 8.0f;
      for (const glm::vec2& point : points) nearest = std::min(nearest, glm::length(point - candidate));
      if (nearest > bestDistance) bestDistance = nearest, best = candidate;
    }
    points.push_back(best);
  }
  // Centred, so that a few taps do not shift the shadow.
  glm::vec2 mean(0.0f);
  for (const glm::vec2& point : points) mean += point / static_cast<float>(count);
  for (glm::vec2& point : points) point -= mean;
  return points;
}

const std::string& poissonTapsDefine(int count) {
  // A constant of each count; engines may live on several threads.
  thread_local std::map<int, std::string> known;
  const auto [place, added] = known.try_emplace(count);
  if (!added) return place->second;
  std::string& define = place->second;
  define = "HS_POISSON_TAPS(TAP)";
  for (const glm::vec2& point : poissonDisc(count)) {
    char tap[64];
    std::snprintf(tap, sizeof tap, " TAP(%.4f, %.4f)", static_cast<double>(point.x),
                  static_cast<double>(point.y));
    define += tap;
  }
  return define;
}

}  // namespace halfshadow::techniques
