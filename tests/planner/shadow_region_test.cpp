// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planner/frame_planner.hpp"

namespace halfshadow::planner {
namespace {

scene::Bounds box(const glm::dvec3& center, const glm::dvec3& half) {
  return {.low = center - half, .high = center + half};
}

const scene::AreaLight kLight{
    .centerWorld = {0, 10, 0}, .halfU = {1, 0, 0}, .halfV = {0, 0, 1}, .emission = {0, -1, 0}};

// Does the ray from the light through the caster point meet the box at or behind that point?
bool rayMeets(const glm::dvec3& light, const glm::dvec3& caster, const scene::Bounds& receiver) {
  double low = 1.0, high = 1e300;  // multiples of (caster - light)
  for (int axis = 0; axis < 3; ++axis) {
    const double direction = caster[axis] - light[axis];
    const double a = receiver.low[axis] - light[axis], b = receiver.high[axis] - light[axis];
    if (direction == 0.0) {
      if (a > 0.0 || b < 0.0) return false;
      continue;
    }
    low = std::max(low, std::min(a / direction, b / direction));
    high = std::min(high, std::max(a / direction, b / direction));
  }
  return low <= high;
}

TEST(ShadowRegion, NeverFalseWhenASampledRayHits) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1), positive(0.02, 1);
  const auto vector = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  int hits = 0, misses = 0, missesFound = 0;
  for (int round = 0; round < 30000; ++round) {
    // Lights of any orientation, some of no size, some sheared; boxes of any shape around and behind them.
    const glm::dvec3 offset = round % 5 == 0 ? glm::dvec3(1e4) * vector() : glm::dvec3(0.0);
    const double scale = round % 7 == 0 ? 1e-3 : 1.0;
    glm::dvec3 u = vector(), v = vector();
    if (round % 2) v -= u * (glm::dot(u, v) / glm::dot(u, u));
    const auto made = scene::areaLightFromVectors(offset, u * scale, v * scale);
    if (!made.ok()) continue;
    scene::AreaLight light = *made;
    if (round % 11 == 0) light.halfU = light.halfV = glm::dvec3(0.0);
    const auto someBox = [&] {
      return box(offset + vector() * 6.0 * scale,
                 glm::dvec3(positive(random), positive(random), positive(random)) * scale);
    };
    const scene::Bounds caster = someBox();
    scene::Bounds receiver = someBox();
    if (round % 3 != 0) {
      // Aimed near the shadow's outline, where a wrong bound shows.
      const glm::dvec3 along = (caster.center() - light.centerWorld) * (0.8 + 2.0 * positive(random));
      receiver =
          box(light.centerWorld + along + vector() * 3.0 * scale, (receiver.high - receiver.low) * 0.5);
    }
    bool hit = false;
    for (int sample = 0; sample < 64 && !hit; ++sample) {
      // Every second sample is an extreme one: corners are where a bound fails first.
      const bool corner = sample % 2 == 0;
      const auto pick = [&] { return corner ? (unit(random) < 0 ? -1.0 : 1.0) : unit(random); };
      const glm::dvec3 l = light.centerWorld + light.halfU * pick() + light.halfV * pick();
      const glm::dvec3 share = glm::dvec3(pick(), pick(), pick()) * 0.5 + 0.5;
      const glm::dvec3 c = caster.low + (caster.high - caster.low) * share;
      if (glm::dot(c - light.centerWorld, light.emission) <= 0.0) continue;  // the light does not emit there
      hit = rayMeets(l, c, receiver);
    }
    const bool meets = shadowRegionMeets(light, caster, receiver);
    if (hit) {
      ++hits;
      ASSERT_TRUE(meets) << "round " << round;
    } else {
      ++misses;
      missesFound += !meets;
    }
  }
  // The test means nothing unless both answers occur often.
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 20000);
  // Tightness: sampling misses some thin hits, so not all can be found; below this the culling is useless.
  EXPECT_GT(missesFound, misses * 0.9);
}

TEST(ShadowRegion, PlainCases) {
  const scene::Bounds caster = box({0, 5, 0}, {1, 1, 1});
  EXPECT_TRUE(shadowRegionMeets(kLight, caster, box({0, 0, 0}, {20, 0.1, 20})));  // ground below
  EXPECT_TRUE(shadowRegionMeets(kLight, caster, caster));                         // itself
  EXPECT_FALSE(shadowRegionMeets(kLight, caster, box({0, 8, 0}, {1, 0.5, 1})));   // between light and caster
  EXPECT_FALSE(shadowRegionMeets(kLight, caster, box({0, 12, 0}, {9, 1, 9})));    // behind the light
  EXPECT_FALSE(shadowRegionMeets(kLight, box({0, 12, 0}, {1, 1, 1}), caster));    // caster behind the light
  EXPECT_FALSE(shadowRegionMeets(kLight, {}, caster));
  EXPECT_FALSE(shadowRegionMeets(kLight, caster, {}));
}

TEST(ShadowRegion, PenumbraEdgeOnTheGround) {
  const scene::Bounds caster = box({0, 5, 0}, {1, 0, 1});
  // From the light's edge x = -1 at height 10 through x = 1 at height 5 the ray lands at x = 3.
  EXPECT_TRUE(shadowRegionMeets(kLight, caster, box({3.5, 0, 0}, {0.501, 0, 0.1})));
  EXPECT_FALSE(shadowRegionMeets(kLight, caster, box({3.5, 0, 0}, {0.499, 0, 0.1})));
}

TEST(ShadowRegion, ObliqueLightIsBoundedByTangentPlanes) {
  // Seen from this light, boxes are rotated, so their extents in light space are far too large: only the
  // planes through box edges tell these apart.
  const auto light = scene::areaLightAimed({10, 10, 10}, {0, 0, 0}, 0.2, 0.2, {0, 1, 0});
  ASSERT_TRUE(light.ok());
  const scene::Bounds caster = box({5, 5, 5}, {2, 0.01, 2});
  EXPECT_TRUE(shadowRegionMeets(*light, caster, box({0, 0, 0}, {0.5, 0.5, 0.5})));
  // Through the corner (7, 5, 3) the shadow reaches (4, 0, -4) and, with the light's size, little more.
  EXPECT_TRUE(shadowRegionMeets(*light, caster, box({3.9, 0, -3.9}, {0.05, 0.05, 0.05})));
  EXPECT_FALSE(shadowRegionMeets(*light, caster, box({4.6, 0, -4.6}, {0.05, 0.05, 0.05})));
}

TEST(ShadowRegion, VisibleFromIsConservativeAndCulls) {
  const scene::Camera camera{
      .eyeWorld = {0, 0, 5}, .targetWorld = {0, 0, 0}, .nearDistance = 0.1, .farDistance = 50};
  EXPECT_TRUE(visibleFrom(camera, 1.0, box({0, 0, 0}, {1, 1, 1})));
  EXPECT_TRUE(visibleFrom(camera, 1.0, box({0, 0, 0}, {100, 100, 100})));  // the camera is inside
  EXPECT_FALSE(visibleFrom(camera, 1.0, box({0, 0, 8}, {1, 1, 1})));       // behind
  EXPECT_FALSE(visibleFrom(camera, 1.0, box({9, 0, 0}, {1, 1, 1})));       // beside
  EXPECT_FALSE(visibleFrom(camera, 1.0, box({0, 0, -60}, {1, 1, 1})));     // beyond far
  EXPECT_TRUE(visibleFrom(camera, 4.0, box({9, 0, 0}, {1, 1, 1})));        // a wider view reaches it
  EXPECT_FALSE(visibleFrom(camera, 1.0, {}));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const glm::dmat4 clipFromWorld = scene::clipFromView(camera, 1.3) * scene::viewFromWorld(camera);
  for (int round = 0; round < 20000; ++round) {
    const glm::dvec3 point = glm::dvec3(unit(random), unit(random), unit(random)) * 20.0;
    const glm::dvec4 clip = clipFromWorld * glm::dvec4(point, 1.0);
    const bool inside = std::max({std::abs(clip.x), std::abs(clip.y), std::abs(clip.z)}) <= clip.w;
    const glm::dvec3 share = glm::dvec3(unit(random), unit(random), unit(random)) * 0.5 + 0.5;
    const glm::dvec3 size(1.0, 3.0, 0.2);
    const scene::Bounds around{.low = point - size * share, .high = point + size * (1.0 - share)};
    if (inside) {
      ASSERT_TRUE(visibleFrom(camera, 1.3, around)) << round;
    }
  }
}

}  // namespace
}  // namespace halfshadow::planner
