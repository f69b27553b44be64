// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/light_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace halfshadow::planner {
namespace {

using Points = std::vector<glm::dvec3>;

scene::AreaLight lightAbove(const glm::dvec3& center, double size) {
  const auto light =
      scene::areaLightAimed(center, center + glm::dvec3(0.2, -1, 0.1), size, size / 2, {0, 0, 1});
  EXPECT_TRUE(light.ok());
  return *light;
}

Points boxPoints(const glm::dvec3& center, const glm::dvec3& half) {
  scene::Bounds bounds{.low = center - half, .high = center + half};
  const auto corners = bounds.corners();
  return {corners.begin(), corners.end()};
}

glm::dvec3 toLight(const LightFit& fit, const glm::dvec3& pointWorld) {
  return glm::dvec3(fit.lightFromWorld * glm::dvec4(pointWorld, 1.0));
}

// Position in the map in texels.
glm::dvec2 texelOf(const LightFit& fit, const glm::dvec3& pointWorld) {
  const glm::dvec3 p = toLight(fit, pointWorld);
  return (glm::dvec2(p) / p.z - fit.tangentLow) * fit.texelsPerTangent();
}

void expectInside(const LightFit& fit, const Points& points, const LightFitOptions& options) {
  ASSERT_FALSE(fit.empty);
  for (const glm::dvec3& point : points) {
    const glm::dvec2 texel = texelOf(fit, point);
    // 1e-6 texels: rounding of the fit, far below a texel.
    EXPECT_GE(std::min(texel.x, texel.y), options.borderTexels - 1e-6);
    EXPECT_LE(std::max(texel.x, texel.y), options.mapSize - options.borderTexels + 1e-6);
    const double depth = fit.storedDepth(toLight(fit, point).z);
    // One quantum of a 16-bit map: after rounding no caster is 0 or 1.
    EXPECT_GT(depth, 1.0 / 65535);
    EXPECT_LT(depth, 1.0 - 1.0 / 65535);
  }
}

TEST(LightFit, RandomCastersLieInsideTheBorderAndTheDepthRange) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 500; ++round) {
    Points points;
    for (int i = 0; i < 20; ++i) {
      points.push_back(glm::dvec3(3 * unit(random), 2 * unit(random), 3 * unit(random)));
    }
    const LightFitOptions options{.mapSize = round % 2 ? 512 : 64, .borderTexels = round % 9};
    expectInside(fitLight(lightAbove({unit(random), 9, unit(random)}, 1.0), points, options), points,
                 options);
  }
}

TEST(LightFit, IsTight) {
  const Points points = boxPoints({0, 0, 0}, {1, 0.2, 1});
  const LightFit fit = fitLight(lightAbove({0, 10, 0}, 1.0), points, {});
  glm::dvec2 low(1e9), high(-1e9);
  for (const glm::dvec3& point : points) {
    const glm::dvec2 texel = texelOf(fit, point);
    low = glm::min(low, texel), high = glm::max(high, texel);
  }
  // 1/16 octave is 4.4 %; the border and the snapped origin take up to 5 of 1024 texels.
  EXPECT_GT(high.x - low.x, 1024 / 1.0443 - 6);
  EXPECT_GT(high.y - low.y, 1024 / 1.0443 - 6);
}

TEST(LightFit, AxesFollowTheLight) {
  const scene::AreaLight light{
      .centerWorld = {1, 2, 3}, .halfU = {0, 0, 2}, .halfV = {0.5, 0, 0}, .emission = {0, 1, 0}};
  const LightFit fit = fitLight(light, Points{{1, 6, 3}}, {});
  ASSERT_FALSE(fit.empty);
  EXPECT_NEAR(glm::length(toLight(fit, light.centerWorld)), 0.0, 1e-12);
  EXPECT_NEAR(glm::length(toLight(fit, light.centerWorld + light.halfU) - glm::dvec3(2, 0, 0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::length(toLight(fit, light.centerWorld + light.halfV) - glm::dvec3(0, 0.5, 0)), 0.0, 1e-12);
  EXPECT_NEAR(toLight(fit, {1, 6, 3}).z, 4.0, 1e-12);  // along cross(u, v) = +y
  EXPECT_NEAR(fit.halfSize.x, 2.0, 1e-12);
  EXPECT_NEAR(fit.halfSize.y, 0.5, 1e-12);
}

TEST(LightFit, ClipMatrixAgreesWithTangentsAndStoredDepth) {
  const Points points = boxPoints({0.3, 0, 0.5}, {1, 0.5, 2});
  const LightFit fit = fitLight(lightAbove({0, 5, 0}, 1.0), points, {});
  for (const glm::dvec3& point : points) {
    const glm::dvec3 p = toLight(fit, point);
    const glm::dvec4 clip = fit.clipFromLight() * glm::dvec4(p, 1.0);
    EXPECT_NEAR(clip.w, p.z, 1e-12);
    const glm::dvec2 texel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * static_cast<double>(fit.mapSize);
    EXPECT_NEAR(glm::length(texel - texelOf(fit, point)), 0.0, 1e-6);
    EXPECT_NEAR(clip.z / clip.w * 0.5 + 0.5, fit.storedDepth(p.z), 1e-12);
  }
  EXPECT_NEAR(fit.storedDepth(fit.nearDistance), 0.0, 1e-12);
  EXPECT_NEAR(fit.storedDepth(fit.farDistance), 1.0, 1e-12);
}

// A caster that moves by less than a texel must not move the grid under the static casters: the fraction of a
// texel at which a static point lies stays the same, and the mapping itself seldom changes.
TEST(LightFit, SubTexelMovesKeepTheGrid) {
  const scene::AreaLight light = lightAbove({0, 10, 0}, 1.0);
  const Points still = boxPoints({0, 0, 0}, {2, 0.5, 2});
  int extentChanges = 0, depthChanges = 0;
  LightFit last;
  for (int step = 0; step <= 1000; ++step) {
    Points points = still;
    const Points moving = boxPoints({2.0 + step * 1e-3, 0.1, 0}, {0.5, 0.3, 0.5});  // half a texel a step
    points.insert(points.end(), moving.begin(), moving.end());
    const LightFit fit = fitLight(light, points, {});
    ASSERT_FALSE(fit.empty);
    if (step > 0) {
      depthChanges += fit.nearDistance != last.nearDistance || fit.farDistance != last.farDistance;
      const bool sameTexels = fit.tangentHigh - fit.tangentLow == last.tangentHigh - last.tangentLow ||
                              glm::length(fit.texelsPerTangent() / last.texelsPerTangent() - 1.0) < 1e-9;
      extentChanges += !sameTexels;
      if (sameTexels) {
        const glm::dvec2 moved = texelOf(fit, still[0]) - texelOf(last, still[0]);
        EXPECT_NEAR(moved.x, std::round(moved.x), 1e-6);
        EXPECT_NEAR(moved.y, std::round(moved.y), 1e-6);
      }
    }
    last = fit;
  }
  // The extent grows from 4.5 to 5.5 units, log2(5.5 / 4.5) * 16 = 4.6 steps, in x only.
  EXPECT_GE(extentChanges, 3);
  EXPECT_LE(extentChanges, 6);
  // The light is tilted by 11 degrees, so that a move of 1 unit changes the depth by .2 of 10: under one step
  // at each end, and 2 or 3 where the ends straddle one.
  EXPECT_LE(depthChanges, 3);
}

TEST(LightFit, CastersBehindTheLightAreEmpty) {
  const scene::AreaLight light = lightAbove({0, 5, 0}, 1.0);
  EXPECT_TRUE(fitLight(light, boxPoints({0, 9, 0}, {1, 1, 1}), {}).empty);
  EXPECT_TRUE(fitLight(light, Points{}, {}).empty);
}

TEST(LightFit, CasterThroughTheLightPlaneIsCutAtNearAndAtTheLargestTangent) {
  const scene::AreaLight light{.halfU = {1, 0, 0}, .halfV = {0, -1, 0}, .emission = {0, 0, -1}};
  const LightFitOptions options;
  const LightFit fit = fitLight(light, boxPoints({3, 0, 0}, {1, 1, 5}), options);
  ASSERT_FALSE(fit.empty);
  EXPECT_GE(fit.nearDistance, options.minNearShare * 5.0);
  EXPECT_LT(fit.nearDistance, options.minNearShare * 5.0 * 1.05);
  EXPECT_GE(fit.tangentHigh.x, options.maxTangent);
  // On its inner side the caster ends at x = 2, z = 5: tangent .4; the map begins before it, but not far.
  EXPECT_LE(fit.tangentLow.x, 0.4);
  EXPECT_GT(fit.tangentLow.x, 0.4 - 0.5);
  EXPECT_LE(fit.tangentHigh.x - fit.tangentLow.x, (options.maxTangent - 0.4) * 1.0443 * 1.006);
}

// In the middle of the map texels stay about as fine as those of a cone of 60 degrees, up to so many as
// asked.
TEST(LightFit, WideWindowsHaveMoreTexels) {
  const scene::AreaLight light{.halfU = {1, 0, 0}, .halfV = {0, -1, 0}, .emission = {0, 0, -1}};
  int grown = 0;
  for (double side = 0.5; side < 12.0; side *= 1.07) {
    const Points points = boxPoints({0, 0, -3}, {side * 2.0, 1, 1});
    const LightFit whole = fitLight(light, points, {.mapSize = 256});
    const LightFit fit = fitLight(light, points, {.mapSize = 256, .mostMapSize = 1024});
    ASSERT_FALSE(fit.empty);
    EXPECT_EQ(whole.mapSize, 256);
    EXPECT_EQ(whole.growth, 1);
    EXPECT_EQ(fit.mapSize, 256 * fit.growth);
    // Twice the tangent of 60 degrees; what it grows by, and half as much again before it grows.
    const double wide = 2.0 * std::sqrt(3.0), extent = fit.tangentHigh.x - fit.tangentLow.x;
    EXPECT_LE(extent / fit.growth, 1.5 * wide * 1.06) << side;
    EXPECT_TRUE(fit.growth == 1 || 2.0 * extent / fit.growth > 1.4 * wide) << side;
    EXPECT_LE(fit.mapSize, 1024);
    const LightFit little = fitLight(light, points, {.mapSize = 256, .mostMapSize = 700});
    EXPECT_LE(little.mapSize, 512);
    grown = std::max(grown, fit.growth);
  }
  EXPECT_EQ(grown, 4);
}

TEST(LightFit, CasterBeyondTheLargestTangentIsEmpty) {
  const scene::AreaLight light{.halfU = {1, 0, 0}, .halfV = {0, -1, 0}, .emission = {0, 0, -1}};
  EXPECT_TRUE(fitLight(light, boxPoints({100, 0, -5}, {1, 1, 1}), {}).empty);
}

TEST(LightFit, NearIsAShareOfTheFarthestCaster) {
  const scene::AreaLight light{.halfU = {1, 0, 0}, .halfV = {0, -1, 0}, .emission = {0, 0, -1}};
  for (const double nearest : {1e-4, 0.05, 0.1, 0.1001, 0.11, 1.0}) {
    const Points points{{0, 0, -nearest}, {0, 0, -100}};
    const LightFit fit = fitLight(light, points, {});
    ASSERT_FALSE(fit.empty);
    EXPECT_GE(fit.nearDistance, 0.1) << nearest;  // 1e-3 of 100
    // Nothing beyond the share is cut.
    if (nearest > 0.1) {
      EXPECT_LE(fit.nearDistance, nearest);
    }
  }
}

TEST(LightFit, PointLightHasAStableFrame) {
  const scene::AreaLight light{.centerWorld = {0, 4, 0}, .emission = {0, -1, 0}};
  const Points points = boxPoints({0, 0, 0}, {1, 1, 1});
  const LightFit fit = fitLight(light, points, {});
  expectInside(fit, points, {});
  EXPECT_EQ(fit.halfSize, glm::dvec2(0.0));
  EXPECT_EQ(fitLight(light, points, {}).lightFromWorld, fit.lightFromWorld);
  const glm::dmat3 rotation(fit.lightFromWorld);
  EXPECT_NEAR(glm::determinant(rotation), 1.0, 1e-12);  // right-handed
  // The same light at a size tending to 0 has the same depths.
  EXPECT_NEAR(toLight(fit, {0.5, -1, 0.5}).z, 5.0, 1e-12);
}

TEST(LightFit, CastersNearerThanTheLightIsWideAreFound) {
  const scene::AreaLight light{.halfU = {1, 0, 0}, .halfV = {0, -1, 0}, .emission = {0, 0, -1}};
  const glm::dmat4 worldFromObject(1.0);
  const auto near = [&](const scene::AreaLight& of, const Points& triangles) {
    scene::TriangleMesh mesh;
    for (const glm::dvec3& point : triangles) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.emplace_back(point);
    }
    const CasterShape caster{.pointsWorld = triangles, .mesh = &mesh, .worldFromObject = &worldFromObject};
    return fitLight(of, {&caster, 1}, {}).casterNearLight;
  };
  const auto sheet = [](double x, double depth) {
    return Points{{x, -50, -depth}, {x, 50, -depth}, {x + 50, 0, -depth}};
  };
  // Two wide: a sheet whose vertices all lie far away passes below it at this depth.
  EXPECT_TRUE(near(light, sheet(-10, 1.9)));
  EXPECT_FALSE(near(light, sheet(-10, 2.1)));
  // Beside it, from one half side and the light's width on.
  EXPECT_TRUE(near(light, sheet(2.9, 0.5)));
  EXPECT_FALSE(near(light, sheet(3.1, 0.5)));
  // In its plane and behind it nothing casts.
  Points plane = sheet(-10, 0.0);
  plane.insert(plane.end(), {{0, 0, -9}, {1, 0, -9}, {0, 1, -9}});
  EXPECT_FALSE(near(light, plane));
  const scene::AreaLight point{.emission = {0, 0, -1}};
  EXPECT_FALSE(near(point, sheet(-10, 1e-3)));
}

// Extents are kept: what stands still, under a light that does, is not looked at again.
TEST(LightFit, OnlyWhatMovedIsMeasured) {
  std::vector<Points> points;
  for (int i = 0; i < 20; ++i) points.push_back(boxPoints({i, 0, 0}, {0.4, 0.4, 0.4}));
  std::vector<CasterShape> casters;
  for (std::size_t i = 0; i < points.size(); ++i)
    casters.push_back({.id = i + 1, .revision = i + 1, .pointsWorld = points[i]});
  const scene::AreaLight light = lightAbove({9, 12, 0}, 1.0);
  LightFitter fitter;
  fitter.fit(light, casters, {});
  EXPECT_EQ(fitter.castersMeasured(), 20u);
  points[7] = boxPoints({7, 0.5, 30}, {0.4, 0.4, 0.4});
  casters[7].pointsWorld = points[7];
  casters[7].revision = 100;
  const LightFit moved = fitter.fit(light, casters, {});
  EXPECT_EQ(fitter.castersMeasured(), 21u);
  const LightFit fresh = fitLight(light, casters, {});
  EXPECT_EQ(moved.tangentLow, fresh.tangentLow);
  EXPECT_EQ(moved.tangentHigh, fresh.tangentHigh);
  EXPECT_EQ(moved.nearestCaster, fresh.nearestCaster);
  casters.erase(casters.begin() + 3);
  fitter.fit(light, casters, {});
  EXPECT_EQ(fitter.castersMeasured(), 21u) << "one left, the others stayed";
  fitter.fit(lightAbove({9, 12.1, 0}, 1.0), casters, {});
  EXPECT_EQ(fitter.castersMeasured(), 21u + 19u) << "the light moved";
}

// Totals of blocks of casters are kept, too.
TEST(LightFit, OfManyCastersIsThatOfAFreshFitter) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<std::shared_ptr<Points>> points;
  std::vector<CasterShape> casters;
  std::uint64_t revision = 0;
  const auto place = [&](std::size_t i) {
    const double far = random() % 8 == 0 ? 30.0 : 10.0;
    // Now and then one reaches to the light and behind it.
    const glm::dvec3 at(far * unit(random), random() % 64 == 0 ? 12.0 : unit(random), far * unit(random));
    points[i] = std::make_shared<Points>(boxPoints(at, glm::dvec3(0.5)));
    casters[i].pointsWorld = *points[i];
    casters[i].revision = ++revision;
  };
  for (std::size_t i = 0; i < 300; ++i) {
    points.emplace_back(), casters.push_back({.id = i + 1});
    place(i);
  }
  const scene::AreaLight light = lightAbove({0, 12, 0}, 1.0);
  LightFitter kept;
  std::uint64_t listed = 1, measured = 0;
  for (int frame = 0; frame < 200; ++frame) {
    std::vector<std::uint32_t> changed;
    for (int i = 0; i < frame % 3; ++i) place(changed.emplace_back(random() % casters.size()));
    if (frame % 17 == 0) {
      const auto gone = static_cast<std::ptrdiff_t>(random() % casters.size());
      points.erase(points.begin() + gone), casters.erase(casters.begin() + gone);
    }
    // Now and then it is not told what changed, or a frame is left out.
    listed += frame % 17 == 0 || frame % 13 == 0 ? 2 : 1;
    const ListChanges changes{frame % 5 == 0 ? 0 : listed, changed};
    const LightFit fit = kept.fit(light, casters, {}, changes), fresh = fitLight(light, casters, {});
    if (frame > 0) {
      EXPECT_LE(kept.castersMeasured() - measured, changed.size()) << frame;
    }
    measured = kept.castersMeasured();
    ASSERT_EQ(fit.tangentLow, fresh.tangentLow) << frame;
    ASSERT_EQ(fit.tangentHigh, fresh.tangentHigh) << frame;
    ASSERT_EQ(fit.nearDistance, fresh.nearDistance) << frame;
    ASSERT_EQ(fit.farthestCaster, fresh.farthestCaster) << frame;
    ASSERT_EQ(fit.nearestCaster, fresh.nearestCaster) << frame;
    ASSERT_EQ(fit.castersCrossPlane, fresh.castersCrossPlane) << frame;
  }
}

TEST(LightFit, OnePointStillMakesAView) {
  const Points points{{0.3, 0, 0.2}};
  const LightFit fit = fitLight(lightAbove({0, 4, 0}, 1.0), points, {});
  expectInside(fit, points, {});
}

// The fit depends on ratios only: the same scene scaled, or moved far away, has the same map.
TEST(LightFit, HugeAndTinyWorlds) {
  const Points points = boxPoints({0.1, 0, 0.2}, {1, 0.5, 0.7});
  const LightFit fit = fitLight(lightAbove({0, 6, 0}, 1.0), points, {});
  const glm::dvec3 offset(1e4, -1e4, 1e4);
  Points far, tiny;
  for (const glm::dvec3& point : points) {
    far.push_back(point + offset);
    tiny.push_back(point * 1e-3);
  }
  const LightFit farFit = fitLight(lightAbove(glm::dvec3(0, 6, 0) + offset, 1.0), far, {});
  const LightFit tinyFit = fitLight(lightAbove({0, 6e-3, 0}, 1e-3), tiny, {});
  expectInside(farFit, far, {});
  expectInside(tinyFit, tiny, {});
  for (const LightFit& other : {farFit, tinyFit}) {
    // 1e-9: 1e4 costs 4 of the 16 digits; scaling costs the last one.
    EXPECT_NEAR(glm::length(other.tangentHigh - fit.tangentHigh), 0.0, 1e-9);
    EXPECT_NEAR(other.farDistance / other.nearDistance, fit.farDistance / fit.nearDistance, 1e-9);
  }
}

}  // namespace
}  // namespace halfshadow::planner
