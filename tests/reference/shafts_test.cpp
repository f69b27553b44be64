// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reference/caster_shafts.hpp"

namespace halfshadow::reference {
namespace {

/// Does the segment from `origin` to `target` cross the triangle? In double, edges included.
bool crosses(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3 (&corners)[3]) {
  const glm::dvec3 direction = target - origin;
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double slope = glm::dot(normal, direction);
  if (slope == 0.0) return false;
  const double t = glm::dot(normal, corners[0] - origin) / slope;
  if (t < 0.0 || t > 1.0) return false;
  const glm::dvec3 hit = origin + t * direction;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
    if (glm::dot(glm::cross(edge, hit - corners[i]), normal) < 0.0) return false;
  }
  return true;
}

// The shortcut must never call a point lit that a caster shadows, wherever point, caster and light are.
TEST(CasterShafts, APointProvedLitIsHitByNoRay) {
  std::mt19937 random(20);
  const auto uniform = [&](double size) {
    return std::uniform_real_distribution<double>(-size, size)(random);
  };
  const auto vector = [&](double size) { return glm::dvec3(uniform(size), uniform(size), uniform(size)); };
  int provedLit = 0, undecided = 0;
  for (int scene = 0; scene < 400; ++scene) {
    std::vector<TraceMesh> casters(1);
    const int triangles = 1 + scene % 12;
    for (int i = 0; i < triangles; ++i) {
      const glm::dvec3 center = vector(0.8);
      for (int corner = 0; corner < 3; ++corner) {
        casters[0].indices.push_back(static_cast<std::uint32_t>(casters[0].positions.size()));
        casters[0].positions.push_back(center + vector(0.2));
      }
    }
    const CasterShafts shafts(casters);
    const TraceLight light{vector(3.0), vector(0.5), vector(0.5)};
    for (int point = 0; point < 20; ++point) {
      const glm::dvec3 origin = vector(2.0);
      if (shafts.mayOcclude(origin, light)) {
        ++undecided;
        continue;
      }
      ++provedLit;
      for (int ray = 0; ray < 64; ++ray) {
        const glm::dvec3 target = light.center + uniform(1.0) * light.halfU + uniform(1.0) * light.halfV;
        for (std::size_t i = 0; i < casters[0].indices.size(); i += 3) {
          const glm::dvec3 corners[3] = {glm::dvec3(casters[0].positions[i]),
                                         glm::dvec3(casters[0].positions[i + 1]),
                                         glm::dvec3(casters[0].positions[i + 2])};
          ASSERT_FALSE(crosses(glm::dvec3(origin), target, corners))
              << "scene " << scene << " point " << point;
        }
      }
    }
  }
  // Both answers must occur, or the test would show nothing.
  EXPECT_GT(provedLit, 2000);
  EXPECT_GT(undecided, 500);
}

TEST(CasterShafts, CastersBehindTheLightOrTheReceiverDoNotCount) {
  TraceMesh triangle;
  triangle.positions = {{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}};
  triangle.indices = {0, 1, 2};
  const CasterShafts shafts({triangle});
  const TraceLight light{{0, 2, 0}, {0.5, 0, 0}, {0, 0, 0.5}};
  EXPECT_TRUE(shafts.mayOcclude({0, -1, 0}, light));
  EXPECT_FALSE(shafts.mayOcclude({0, 1, 0}, light)) << "the caster is behind the receiver";
  EXPECT_FALSE(shafts.mayOcclude({0, 4, 0}, light)) << "the caster is behind the light";
  EXPECT_TRUE(shafts.mayOcclude({3, 2, 0}, light)) << "in the light's plane nothing is proved";
  EXPECT_FALSE(CasterShafts({}).mayOcclude({0, -1, 0}, light));
}

}  // namespace
}  // namespace halfshadow::reference
