// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/sub_lights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace halfshadow::planner {
namespace {

scene::AreaLight randomLight(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const glm::dvec3 center(unit(random), 10.0 + unit(random), unit(random));
  const auto aimed = scene::areaLightAimed(center, {unit(random), 0.0, unit(random)}, 1.5 + unit(random),
                                           1.5 + unit(random), {0.3, 0.1, 1.0});
  EXPECT_TRUE(aimed.ok());
  scene::AreaLight light = *aimed;
  // A parallelogram as well: its sides need not be perpendicular.
  light.halfV += 0.3 * unit(random) * light.halfU;
  return light;
}

std::vector<glm::dvec3> randomPoints(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 60; ++i)
    points.emplace_back(2.0 * unit(random), 3.0 + unit(random), 2.0 * unit(random));
  return points;
}

glm::dvec2 texelOf(const LightFit& fit, const glm::dvec3& pointWorld) {
  const glm::dvec3 p(fit.lightFromWorld * glm::dvec4(pointWorld, 1.0));
  return (glm::dvec2(p) / p.z - fit.tangentLow) * fit.texelsPerTangent();
}

// What shaders rely on: from the place that the centre sees, all others follow by the distance alone.
TEST(SubLights, PlacesInAllMapsDifferByTheDistanceAlone) {
  std::mt19937 random(7);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const scene::AreaLight light = randomLight(random);
    const auto points = randomPoints(random);
    const SubLightGrid grid{1 + repeat % 4, 1 + repeat / 4 % 4};
    const SubLights split = fitSubLights(light, points, grid, subLightMapSize(grid, 1024));
    ASSERT_FALSE(split.shared.empty);
    ASSERT_EQ(split.fits.size(), static_cast<std::size_t>(grid.count()));
    for (int k = 0; k < grid.count(); ++k) {
      const LightFit& fit = split.fits[static_cast<std::size_t>(k)];
      const int i = k % grid.alongU, j = k / grid.alongU;
      // The centre of the k-th of equal parts, from the light's own corners.
      const double a = (2.0 * i + 1.0) / grid.alongU - 1.0, b = (2.0 * j + 1.0) / grid.alongV - 1.0;
      const glm::dvec3 center = light.centerWorld + a * light.halfU + b * light.halfV;
      EXPECT_NEAR(glm::length(glm::dvec3(fit.lightFromWorld * glm::dvec4(center, 1.0))), 0.0, 1e-9);
      const glm::dvec2 step =
          (i - 0.5 * (grid.alongU - 1)) * split.stepU + (j - 0.5 * (grid.alongV - 1)) * split.stepV;
      for (const glm::dvec3& point : points) {
        const double z = glm::dvec3(split.shared.lightFromWorld * glm::dvec4(point, 1.0)).z;
        const glm::dvec2 expected =
            texelOf(split.shared, point) +
            split.shared.texelsPerTangent() * step * (1.0 / split.shared.alignedDistance - 1.0 / z);
        EXPECT_NEAR(glm::length(texelOf(fit, point) - expected), 0.0, 1e-6);
      }
    }
  }
}

TEST(SubLights, EveryMapHoldsAllCastersAndItsBorder) {
  std::mt19937 random(11);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const scene::AreaLight light = randomLight(random);
    const auto points = randomPoints(random);
    const SubLights split = fitSubLights(light, points, {3, 3}, subLightMapSize({3, 3}, 1024));
    for (const LightFit& fit : split.fits) {
      for (const glm::dvec3& point : points) {
        const glm::dvec2 texel = texelOf(fit, point);
        EXPECT_GE(std::min(texel.x, texel.y), 2.0 - 1e-6);
        EXPECT_LE(std::max(texel.x, texel.y), fit.mapSize - 2.0 + 1e-6);
      }
    }
  }
}

TEST(SubLights, MapsShareTheTexelsAndHalveEvenly) {
  for (int mapSize = 16; mapSize <= 8192; mapSize += mapSize < 600 ? 1 : 37) {
    for (int u = 1; u <= kMostSubLightsPerSide; ++u) {
      for (int v = 1; v <= kMostSubLightsPerSide; ++v) {
        const SubLightGrid grid{u, v};
        const int tiles = grid.tilesPerSide();
        EXPECT_GE(tiles * tiles, grid.count());
        int side = subLightMapSize(grid, mapSize);
        if (grid.whole()) {
          EXPECT_EQ(side, mapSize);
          continue;
        }
        // A map that has 64 texels or more with rounding is one.
        if (mapSize / tiles >= 64) {
          EXPECT_GT(side, 0) << mapSize << " " << u << "x" << v;
        }
        if (side == 0) {
          EXPECT_LT(mapSize / tiles, 64);
          continue;
        }
        EXPECT_LE(tiles * side * tiles * side, 1.3 * mapSize * mapSize)
            << "no more memory than one map, about";
        EXPECT_GT(side, 0.8 * (mapSize / tiles)) << "sides a fifth apart, of which the next may be larger";
        const int kept = subLightMapSize(grid, mapSize, mapSize);
        EXPECT_LE(tiles * kept, mapSize) << "what a texture holds";
        EXPECT_EQ(side % 16, 0);
        while (side > 6) {
          EXPECT_EQ(side % 2, 0) << mapSize;
          side /= 2;
        }
      }
    }
  }
}

TEST(SubLights, FollowTheLightsShape) {
  scene::AreaLight light;
  light.halfU = {2, 0, 0}, light.halfV = {0, 0, 2};
  EXPECT_EQ(subLightGrid(light, 3), (SubLightGrid{3, 3}));
  light.halfV = {0, 0, 0.1};
  EXPECT_EQ(subLightGrid(light, 4), (SubLightGrid{4, 1}));
  light.halfU = {0.1, 0, 0}, light.halfV = {0, 0, 2};
  EXPECT_EQ(subLightGrid(light, 3), (SubLightGrid{1, 3}));
  light.halfU = light.halfV = glm::dvec3(0);
  EXPECT_TRUE(subLightGrid(light, 4).whole()) << "a point has no parts";
  // Odd numbers along one side stay odd along the other: there is a sub-light in the middle.
  for (double ratio = 0.05; ratio <= 1.0; ratio += 0.01) {
    light.halfU = {1, 0, 0}, light.halfV = {0, 0, ratio};
    EXPECT_TRUE(subLightGrid(light, 3).hasMiddle()) << ratio;
  }
}

TEST(SubLights, AutoSplitsWidePenumbraeAlone) {
  EXPECT_EQ(chooseSubLights({.widestPenumbraTexels = 5}).perSide, 1);
  EXPECT_EQ(chooseSubLights({.widestPenumbraTexels = 300}).perSide, 3);
  EXPECT_NE(chooseSubLights({.widestPenumbraTexels = 5}).reason.find("penumbra-narrow:"), std::string::npos);
  EXPECT_NE(chooseSubLights({.widestPenumbraTexels = 300}).reason.find("penumbra-wide:"), std::string::npos);
}

}  // namespace
}  // namespace halfshadow::planner
