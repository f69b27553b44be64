// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "scene/light_silhouettes.hpp"
#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {
using scene::LightPlane;
using scene::LightSilhouettes;
using scene::PlacedCaster;

class LightSilhouetteCacheTest : public ::testing::Test {
 protected:
  LightSilhouetteCacheTest() {
    for (std::uint32_t i = 0; i < 20; ++i) casters.push_back({&mesh, at(i), i + 100, i + 1});
  }
  static glm::dmat4 at(double x) { return glm::translate(glm::dmat4(1.0), glm::dvec3(3.0 * x, 0.1 * x, 0)); }

  void expectSameAsAnew(const LightSilhouettes& cached) const {
    LightSilhouettes anew;
    scene::lightSilhouettes(casters, plane, 0.5, 0.5, 1e-3, anew);
    EXPECT_EQ(cached.points, anew.points);
    ASSERT_EQ(cached.loops.size(), anew.loops.size());
    for (std::size_t i = 0; i < anew.loops.size(); ++i) {
      EXPECT_EQ(cached.loops[i].first, anew.loops[i].first);
      EXPECT_EQ(cached.loops[i].count, anew.loops[i].count);
    }
    ASSERT_EQ(cached.casters.size(), anew.casters.size());
    for (std::size_t i = 0; i < anew.casters.size(); ++i) {
      EXPECT_EQ(cached.casters[i].object, anew.casters[i].object);
      EXPECT_EQ(cached.casters[i].firstLoop, anew.casters[i].firstLoop);
      EXPECT_EQ(cached.casters[i].loopCount, anew.casters[i].loopCount);
      EXPECT_EQ(cached.casters[i].low, anew.casters[i].low);
    }
  }

  scene::HalfEdgeMesh mesh = scene::HalfEdgeMesh::build(sphere(2).mesh());
  std::vector<PlacedCaster> casters;
  LightPlane plane{scene::areaLightAimed({20, 30, 5}, {30, 0, 0}, 2, 2, {0, 0, 1}).value(), 30.0, 1e-4};
  scene::CasterSilhouettes extracted;
  scene::LightSilhouetteCache cache;

  void expectWork(std::uint32_t placed, std::uint32_t reused) const {
    EXPECT_EQ(cache.counters().placed, placed);
    EXPECT_EQ(cache.counters().reused, reused);
    EXPECT_EQ(cache.changedObjects().size(), placed);
  }
};

TEST_F(LightSilhouetteCacheTest, PlacesOnlyWhatChanged) {
  expectSameAsAnew(cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3));
  expectWork(20, 0);
  const std::uint64_t first = cache.generation();
  expectSameAsAnew(cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3));
  expectWork(0, 20);
  EXPECT_EQ(cache.generation(), first);
  casters[7].worldFromObject = at(7.3);
  casters[7].revision = 99;
  expectSameAsAnew(cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3));
  expectWork(1, 19);
  EXPECT_EQ(cache.changedObjects()[0], 107u);
  EXPECT_NE(cache.generation(), first);
}

TEST_F(LightSilhouetteCacheTest, CastersComeGoAndChangePlaces) {
  cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3);
  std::swap(casters[2], casters[11]);
  expectSameAsAnew(cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3));
  expectWork(0, 20);
  const PlacedCaster gone = casters[4];
  casters.erase(casters.begin() + 4);
  expectSameAsAnew(cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3));
  expectWork(0, 19);
  casters.push_back(gone);
  expectSameAsAnew(cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3));
  expectWork(1, 19);
  casters.clear();
  EXPECT_TRUE(cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3).casters.empty());
}

TEST_F(LightSilhouetteCacheTest, AnotherLightPlacesAll) {
  cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3);
  cache.update(extracted, casters, plane, -0.5, 0.5, 1e-3);
  expectWork(20, 0);
  cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3);
  plane.centerWorld.x += 0.25;
  expectSameAsAnew(cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3));
  expectWork(20, 0);
}

TEST_F(LightSilhouetteCacheTest, UnknownRevisionsAreNeverReusedAndSharedNumbersAreToldApart) {
  casters[3].revision = 0;
  casters[5].object = casters[6].object;
  cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3);
  expectWork(20, 0);
  expectSameAsAnew(cache.update(extracted, casters, plane, 0.5, 0.5, 1e-3));
  expectWork(1, 19);
}

}  // namespace
}  // namespace halfshadow::testing
