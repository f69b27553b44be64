// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/light_reach.hpp"

#include <gtest/gtest.h>

#include <random>

namespace halfshadow::planner {
namespace {

scene::AreaLight sunAt(double distance) {
  const glm::dvec3 direction = glm::normalize(glm::dvec3(3, 12, 2));
  auto light =
      scene::areaLightAimed(distance * direction, {0, 0, 0}, 0.01 * distance, 0.02 * distance, {0, 0, 1});
  EXPECT_TRUE(light.ok());
  return *light;
}

scene::Bounds boundsOf(const std::vector<glm::dvec3>& points) {
  scene::Bounds bounds;
  for (const glm::dvec3& point : points) bounds.include(point);
  return bounds;
}

// Rays from a receiver through the same share of the light keep their direction, to a hundredth of the
// light's own width or better.
TEST(LightReach, DirectionsStay) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (const double distance : {1e2, 1e4, 1e6, 1e8, 1e12}) {
    for (const double size : {1e-3, 1.0, 300.0}) {
      const glm::dvec3 place(40.0, -7.0, 1000.0);
      const scene::AreaLight sun = sunAt(distance);
      std::vector<glm::dvec3> casters;
      for (int i = 0; i < 9; ++i)
        casters.push_back(place + size * glm::dvec3(share(random), share(random), share(random)));
      const scene::AreaLight nearer = lightWithinReach(sun, boundsOf(casters));
      for (int i = 0; i < 50; ++i) {
        const glm::dvec3 receiver = casters[static_cast<std::size_t>(i % 9)];
        const double a = share(random), b = share(random);
        const auto towards = [&](const scene::AreaLight& light) {
          return glm::normalize(light.centerWorld + a * light.halfU + b * light.halfV - receiver);
        };
        EXPECT_LT(glm::length(towards(sun) - towards(nearer)), 2.0 / kLightReach) << distance << " " << size;
      }
      // The casters' half diagonal is at most 1.8 sizes, the grid two of those, and octaves are whole.
      const double farthest = 2.0 * kLightReach * 4.0 * size + 8.0 * size;
      EXPECT_LE(glm::length(nearer.centerWorld - place), farthest) << distance << " " << size;
    }
  }
}

TEST(LightReach, NearLightsAndSmallMovesChangeNothing) {
  const std::vector<glm::dvec3> casters = {{-1, 0, -1}, {1, 0, 1}, {0, 2, 0}};
  const scene::AreaLight lamp = sunAt(12.0);
  EXPECT_EQ(lightWithinReach(lamp, boundsOf(casters)).centerWorld, lamp.centerWorld);
  EXPECT_EQ(lightWithinReach(lamp, boundsOf(casters)).halfU, lamp.halfU);
  const scene::AreaLight sun = sunAt(1e7);
  std::vector<glm::dvec3> moved = casters;
  for (glm::dvec3& point : moved) point += glm::dvec3(0.1, 0.02, -0.1);
  EXPECT_EQ(lightWithinReach(sun, boundsOf(casters)).centerWorld,
            lightWithinReach(sun, boundsOf(moved)).centerWorld);
  EXPECT_EQ(lightWithinReach(sun, {}).centerWorld, sun.centerWorld);
}

}  // namespace
}  // namespace halfshadow::planner
