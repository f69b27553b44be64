// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Volumes of casters: every receiver that a caster can shadow lies in exactly one of its volumes, and no two
// of a batch share one.
#include <gtest/gtest.h>

#include <random>

#include "techniques/parts/caster_volumes/caster_volumes.hpp"

namespace halfshadow::techniques {
namespace {

glm::vec3 tangent(const glm::dvec3& abh) {
  return glm::vec3(outlines::tangentPoint(abh));
}

/// A closed loop around `center` in (a, b, h), tilted.
outlines::CasterLoops ring(const glm::dvec3& center, double radius, double rise) {
  std::vector<glm::vec3> loop;
  for (int k = 0; k < 12; ++k) {
    const double angle = 6.283185307179586 * k / 12.0;
    loop.push_back(tangent(
        center + glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), rise * std::cos(angle))));
  }
  outlines::CasterLoops caster;
  caster.addLoop(loop);
  return caster;
}

/// A receiver on the ray from a point of the light through one of a caster's vertices.
struct Receiver {
  glm::dvec3 abh{0.0};
  double i = 0.0;
};
Receiver behind(const outlines::CasterLoops& caster, const outlines::SubLight& light, double end,
                std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const glm::vec3 ti = caster.points[random() % caster.points.size()];
  const glm::dvec3 vertex(ti.x / ti.z, ti.y / ti.z, 1.0 / ti.z);
  const glm::dvec3 source(light.center.x + light.half * (2.0 * unit(random) - 1.0),
                          light.center.y + light.half * (2.0 * unit(random) - 1.0), 0.0);
  const double farthest = end / vertex.z, along = 1.0 + (farthest - 1.0) * unit(random);
  const glm::dvec3 abh = source + along * (vertex - source);
  return {abh, 1.0 / abh.z};
}

bool inside(const CasterVolume& volume, const Receiver& receiver) {
  constexpr double kRounding = 1e-5;
  const bool beyond = receiver.i <= static_cast<double>(volume.splitI);
  if (beyond != (volume.part == WedgePart::beyond)) return false;
  const double h = receiver.abh.z;
  const glm::dvec2 low = volume.extent.low(h) - kRounding, high = volume.extent.high(h) + kRounding;
  const glm::dvec2 at(receiver.abh);
  return h >= volume.from - kRounding && h <= volume.end + kRounding &&
         glm::all(glm::greaterThanEqual(at, low)) && glm::all(glm::lessThanEqual(at, high));
}

outlines::SubLightLoops crowd(const outlines::SubLight& light) {
  outlines::SubLightLoops loops{.light = light};
  for (int x = -3; x <= 3; ++x) {
    for (int y = -3; y <= 3; ++y) {
      loops.casters.push_back(ring({6.0 * x, 6.0 * y, 0.5 + 0.02 * (x + y)}, 1.2, 0.03 * (x - y)));
    }
  }
  return loops;
}

TEST(CasterVolumes, EveryShadowedReceiverHasOneVolumeOfItsCaster) {
  std::mt19937 random(11);
  const VolumeReach reach{.end = 1.0, .sideways = 64.0};
  for (const outlines::SubLight& light : outlines::subLights()) {
    const outlines::SubLightLoops loops = crowd(light);
    const CasterVolumes volumes = casterVolumes({&loops, 1}, outlines::ListSpace(), reach, Batching::none);
    ASSERT_EQ(volumes.volumes.size(), 2 * loops.casters.size());
    ASSERT_EQ(volumes.batchCount, 1u);
    for (int trial = 0; trial < 5000; ++trial) {
      const std::size_t c = random() % loops.casters.size();
      const Receiver receiver = behind(loops.casters[c], light, reach.end, random);
      int containing = 0;
      for (const CasterVolume& volume : volumes.volumes) {
        containing += volume.caster == c && inside(volume, receiver);
      }
      ASSERT_EQ(containing, 1) << "caster " << c << ", height " << receiver.abh.z;
    }
  }
}

TEST(CasterVolumes, NoTwoOfABatchShareAReceiver) {
  std::mt19937 random(12);
  const outlines::SubLight light{glm::vec2(0.0f), 1.0f};
  const outlines::SubLightLoops loops = crowd(light);
  const VolumeReach reach{.end = 1.0, .sideways = 64.0};
  const CasterVolumes volumes = casterVolumes({&loops, 1}, outlines::ListSpace(), reach, Batching::disjoint);
  // Penumbrae are about as wide as the casters stand apart: some neighbours meet, not all.
  EXPECT_GT(volumes.batchCount, 1u);
  EXPECT_LT(volumes.batchCount, 20u);
  for (int trial = 0; trial < 20000; ++trial) {
    const Receiver receiver =
        behind(loops.casters[random() % loops.casters.size()], light, reach.end, random);
    std::vector<int> inBatch(volumes.batchCount, 0);
    for (const CasterVolume& volume : volumes.volumes) inBatch[volume.batch] += inside(volume, receiver);
    for (std::uint32_t batch = 0; batch < volumes.batchCount; ++batch) {
      ASSERT_LE(inBatch[batch], 1) << "batch " << batch << ", height " << receiver.abh.z;
    }
  }
}

TEST(CasterVolumes, LayersStandForACasterBehindIt) {
  const outlines::SubLight light{glm::vec2(0.0f), 1.0f};
  outlines::SubLightLoops loops{.light = light};
  loops.casters = {ring({0, 0, 0.5}, 2.0, 0.05)};
  loops.layers = {ring({0, 0, 0.5}, 2.0, 0.05), ring({0.5, 0, 0.5}, 1.0, 0.02)};
  loops.casters[0].layerCount = 2;
  const CasterVolumes volumes =
      casterVolumes({&loops, 1}, outlines::ListSpace(), {.end = 1.0, .sideways = 64.0}, Batching::disjoint);
  // One at the caster's own heights; behind it one a layer, which overlap.
  ASSERT_EQ(volumes.volumes.size(), 3u);
  EXPECT_EQ(volumes.batchCount, 2u);
  int beside = 0;
  for (const CasterVolume& volume : volumes.volumes) {
    beside += volume.part == WedgePart::beside;
    EXPECT_EQ(volume.splitI, volumes.volumes[0].splitI) << "all split receivers at the caster's height";
  }
  EXPECT_EQ(beside, 1);
}

TEST(CasterVolumes, AnEnclosedLightNeedsNone) {
  outlines::SubLightLoops loops{.light = {glm::vec2(0.0f), 1.0f}};
  loops.casters = {ring({0, 0, 0.5}, 2.0, 0.05)};
  loops.casters[0].enclosesLight = true;
  const CasterVolumes volumes =
      casterVolumes({&loops, 1}, outlines::ListSpace(), {.end = 1.0, .sideways = 64.0}, Batching::none);
  EXPECT_TRUE(volumes.lightEnclosed[0]);
  EXPECT_TRUE(volumes.volumes.empty());
}

}  // namespace
}  // namespace halfshadow::techniques
