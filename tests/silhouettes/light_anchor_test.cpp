// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The origin of a light's coordinates stands where its nearest caster does.
#include "scene/light_anchor.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/light_silhouettes.hpp"
#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {
using scene::Bounds;

Bounds boxAt(const glm::dvec3& center, double half) {
  Bounds box;
  box.include(center - half);
  box.include(center + half);
  return box;
}

TEST(LightAnchor, SinglePrecisionHoldsCastersUnderLampsAndSuns) {
  Random random(3);
  for (const double distance : {0.5, 3.0, 1e2, 1e4, 1e7}) {
    for (int round = 0; round < 50; ++round) {
      const glm::dvec3 target = random.inBox(20.0), from = random.direction();
      const auto light = scene::areaLightAimed(target + from * (distance + 2.0), target, 0.1 * distance,
                                               0.2 * distance, random.direction());
      ASSERT_TRUE(light);
      const std::vector<Bounds> casters = {boxAt(target, 1.0), boxAt(target - 50.0 * from, 7.0)};
      const scene::LightPlane plane(*light, scene::toAnchor(*light, casters), 0.0);
      for (int i = 0; i < 20; ++i) {
        const glm::dvec3 point = target + random.inBox(1.0);
        // What a shader does: a difference in single precision, and linear maps of it.
        const glm::vec3 rounded(plane.axes * (point - plane.unitHeightWorld()));
        const glm::dvec3 back = plane.unitHeightWorld() + glm::dvec3(rounded).x * plane.halfU +
                                glm::dvec3(rounded).y * plane.halfV +
                                glm::dvec3(rounded).z * plane.toUnitHeight;
        EXPECT_LT(glm::length(back - point), 1e-5) << distance;
        EXPECT_LT(glm::length(plane.toWorld(plane.fromWorld(point)) - point), 1e-7 * (1.0 + distance));
      }
    }
  }
}

TEST(LightAnchor, FarCastersAndWideBoxesChangeNothing) {
  const auto light = scene::areaLightAimed({3, 12, 2}, {0, 1, 0}, 0.6, 0.6, {0.2, 0.1, 1.0});
  ASSERT_TRUE(light);
  const std::vector<Bounds> one = {boxAt({0, 2, 0}, 1.0)};
  for (const double away : {1e2, 1e5, 1e9}) {
    const std::vector<Bounds> two = {boxAt({0, -away, away}, 3.0), one[0]};
    EXPECT_EQ(scene::toAnchor(*light, one), scene::toAnchor(*light, two));
  }
  // A small motion of the nearest one mostly does not, either.
  int changed = 0;
  for (int i = 0; i < 100; ++i) {
    const std::vector<Bounds> moved = {boxAt({0.002 * i, 2, 0}, 1.0)};
    const std::vector<Bounds> before = {boxAt({0.002 * (i - 1), 2, 0}, 1.0)};
    changed += scene::toAnchor(*light, moved) != scene::toAnchor(*light, before);
  }
  EXPECT_LE(changed, 3);
}

TEST(LightAnchor, IsBeforeTheLightWhereverCastersAre) {
  Random random(5);
  for (int round = 0; round < 1000; ++round) {
    const auto light = scene::areaLightAimed(random.inBox(3.0), random.inBox(3.0), random.between(0.0, 2.0),
                                             random.between(0.0, 2.0), random.direction());
    if (!light) continue;
    std::vector<Bounds> casters;
    for (int i = 0; i < round % 4; ++i) casters.push_back(boxAt(random.inBox(4.0), random.between(0.0, 5.0)));
    const glm::dvec3 to = scene::toAnchor(*light, casters);
    EXPECT_GT(glm::dot(to, scene::emissionDirection(*light)), 0.05 * glm::length(to));
    EXPECT_TRUE(std::isfinite(glm::length(to)));
  }
}

}  // namespace
}  // namespace halfshadow::testing
