// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/solidity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

namespace halfshadow::scene {
namespace {

/// A grid over longitude and latitude; from `first` to `last` of `rings` rings, so that caps may be left out.
TriangleMesh ballMesh(int rings, int first, int last, double scale = 1.0) {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  const int around = 2 * rings;
  for (int ring = 0; ring <= rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const double theta = std::numbers::pi * ring / rings, phi = 2 * std::numbers::pi * i / around;
      for (const double value :
           {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)})
        positions.push_back(static_cast<float>(scale * value));
    }
  }
  const auto vertex = [&](int ring, int i) { return static_cast<std::uint32_t>(ring * around + i % around); };
  for (int ring = first; ring < last; ++ring) {
    for (int i = 0; i < around; ++i) {
      for (const std::uint32_t index : {vertex(ring, i), vertex(ring, i + 1), vertex(ring + 1, i),
                                        vertex(ring, i + 1), vertex(ring + 1, i + 1), vertex(ring + 1, i)})
        indices.push_back(index);
    }
  }
  auto mesh = buildMesh({.positions = positions.data(),
                         .vertexCount = static_cast<std::uint32_t>(positions.size() / 3),
                         .indices = indices.data(),
                         .indexCount = indices.size()});
  EXPECT_TRUE(mesh.ok());
  return std::move(mesh).value();
}

TEST(Solidity, OfAClosedMeshIsOne) {
  EXPECT_EQ(solidity(ballMesh(12, 0, 12)), 1.0);
}

TEST(Solidity, OfACardIsZero) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::uint32_t indices[] = {0, 1, 2, 0, 2, 3};
  auto card = buildMesh({.positions = positions, .vertexCount = 4, .indices = indices, .indexCount = 6});
  ASSERT_TRUE(card.ok());
  EXPECT_EQ(solidity(*card), 0.0);
}

/// Of a unit ball without the cap of half angle `cap`: chords that leave its surface at one angle below the
/// horizon end on a circle about their beginning, of half angle `reach`. The share of all that begin on what
/// is left and end there too.
double shareThatEndsInside(double cap, double reach) {
  double begun = 0.0, lost = 0.0;
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = cap + (std::numbers::pi - cap) * (i + 0.5) / kSteps;
    const double weight = std::sin(theta);
    begun += weight;
    // Law of cosines on the sphere: where the circle enters the cap.
    const double enters =
        (std::cos(cap) - std::cos(theta) * std::cos(reach)) / (std::sin(theta) * std::sin(reach));
    lost += weight * std::acos(std::clamp(enters, -1.0, 1.0)) / std::numbers::pi;
  }
  return 1.0 - lost / begun;
}

TEST(Solidity, OfABallWithAHoleIsWhatDoesNotLeaveThroughTheHole) {
  for (const int missing : {2, 6, 10, 14, 18, 20}) {
    const int rings = 24;
    // Ways lie atan(.17) below the horizon.
    const double expected = shareThatEndsInside(std::numbers::pi * missing / rings, 2.0 * std::atan(0.17));
    // 128 rays of a random kind would have a standard deviation of at most .044; these lie more evenly.
    EXPECT_NEAR(solidity(ballMesh(rings, 0, rings - missing)), expected, 0.09) << missing;
  }
}

TEST(Solidity, DoesNotChangeWithTheSize) {
  const double one = solidity(ballMesh(10, 0, 7));
  for (const double scale : {1e-12, 1e-3, 1e3, 1e12})
    EXPECT_EQ(solidity(ballMesh(10, 0, 7, scale)), one) << scale;
}

// A budget of tests, not of meshes: a million triangles are looked at by fewer rays.
TEST(Solidity, LooksAtADenseMeshByFewerRays) {
  const double dense = solidity(ballMesh(300, 0, 200)), coarse = solidity(ballMesh(40, 0, 27));
  // 16 rays: four standard deviations of a share near .8.
  EXPECT_NEAR(dense, coarse, 0.4);
}

}  // namespace
}  // namespace halfshadow::scene
