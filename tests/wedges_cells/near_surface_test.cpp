// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Lists of faces for receivers among a caster's own surfaces against rays: how often a ray to the light
// leaves the caster.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "near_surface_rig.hpp"

namespace halfshadow::test {
namespace {

scene::TriangleMesh box(const glm::vec3& half) {
  scene::TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.positions.emplace_back(k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z);
  }
  mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

TEST(NearSurface, FacesCoverWhatRaysDoNotPass) {
  // 576 samples: .01 at half coverage, stratified; layers that overlap within one of sixteen cells add a
  // little.
  for (const double half : {0.3, 1.0, 2.0}) {
    const Deviation bumpy =
        deviation(bumpyBall(32, 20), half, 5, half < 0.5 ? Origin::caster : Origin::light);
    const double rmse = std::sqrt(bumpy.square / std::max(bumpy.receivers, 1));
    std::printf("half size %.1f: %d receivers, %d in penumbra, rmse %.4f, largest %.3f\n", half,
                bumpy.receivers, bumpy.penumbra, rmse, bumpy.largest);
    EXPECT_GT(bumpy.receivers, 300);
    EXPECT_GT(bumpy.penumbra, 30);
    EXPECT_LE(rmse, 0.012) << half;
    EXPECT_LE(bumpy.largest, 0.09) << half;
  }
}

// Where the light stands over a wall, on both sides of its plane, rays to some of it enter the caster by the
// wall that others leave it by: what enters is not to be taken from what leaves.
TEST(NearSurface, WallsUnderTheLightHideWhatIsBehindThem) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Deviation foot =
        deviationAtFoot(angleIron(0.7f * static_cast<float>(seed)), 1.5, seed, outlines::subLights());
    const double rmse = std::sqrt(foot.square / std::max(foot.receivers, 1));
    std::printf("%d receivers, %d in penumbra, rmse %.4f, largest %.3f\n", foot.receivers, foot.penumbra,
                rmse, foot.largest);
    EXPECT_GT(foot.receivers, 1000);
    EXPECT_GT(foot.penumbra, 300);
    // 36 rays a cell, stratified: .003.
    EXPECT_LE(rmse, 0.006) << seed;
    EXPECT_LE(foot.largest, 0.03) << seed;
  }
}

TEST(NearSurface, OpenSheetsHideFromBothSides) {
  for (const double half : {1.0}) {
    const Deviation bent = deviation(bentSheet(24), half, 3, Origin::caster, Surface::open);
    const double rmse = std::sqrt(bent.square / std::max(bent.receivers, 1));
    std::printf("half size %.1f: %d receivers, %d in penumbra, rmse %.4f, largest %.3f\n", half,
                bent.receivers, bent.penumbra, rmse, bent.largest);
    EXPECT_GT(bent.receivers, 300);
    EXPECT_GT(bent.penumbra, 30);
    EXPECT_LE(rmse, 0.012) << half;
    EXPECT_LE(bent.largest, 0.09) << half;
  }
}

TEST(NearSurface, TilesAskAboutAFacetOnceForAllSubLights) {
  const scene::TriangleMesh ball = bumpyBall(48, 30);
  const auto quarters = outlines::subLights();
  const ListCost whole = ownListCost(ball, 1.0, {&outlines::kWholeLight, 1}),
                 four = ownListCost(ball, 1.0, quarters);
  std::printf("%zu facets, %zu tiles with lists: %.1f facets asked about per tile, of four sub-lights %.1f\n",
              four.facets, four.tiles, double(whole.facetTests) / double(whole.tiles),
              double(four.facetTests) / double(four.tiles));
  ASSERT_GT(four.tiles, 100u);
  EXPECT_GT(four.facetTests, 0u);
  // Whoever is out of reach of the whole light is out of reach of its quarters.
  EXPECT_LE(four.facetTests, whole.facetTests);
  // Those in reach of a block of 8 x 8 tiles, not all of them.
  EXPECT_LT(four.facetTests, four.tiles * four.facets / 2);
  EXPECT_GT(four.records, whole.records);
}

TEST(NearSurface, CoarseConvexCastersKnowTheirOwnHorizon) {
  // A plate whose top face's plane cuts the light: seen from some quarters' centres it shows its other side.
  scene::TriangleMesh plate = box({0.8f, 0.6f, 0.02f});
  for (glm::vec3& p : plate.positions) {
    const float c = std::cos(0.05f), s = std::sin(0.05f);
    p = {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
  }
  int receivers = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Deviation found = deviation(plate, 2.0, seed, seed % 2 ? Origin::light : Origin::caster);
    receivers += found.receivers;
    EXPECT_LE(found.largest, 0.06) << seed;
  }
  EXPECT_GT(receivers, 50);
}

}  // namespace
}  // namespace halfshadow::test
