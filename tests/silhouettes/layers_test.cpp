// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <cmath>

#include "scene/light_silhouettes.hpp"
#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {
using scene::HalfEdgeMesh;
using scene::LayerSplit;
using scene::LightPlane;
using scene::LightSilhouettes;
using scene::PlacedCaster;

/// Turns of the entry's loops around the ray from `source` through `target`.
int winding(const LightSilhouettes& silhouettes, const LightSilhouettes::Caster& caster,
            const glm::dvec2& source, const glm::dvec3& target) {
  const auto flat = [&](const glm::dvec3& p) { return (glm::dvec2(p) - source) / p.z; };
  int turns = 0;
  for (std::uint32_t l = caster.firstLoop; l < caster.firstLoop + caster.loopCount; ++l) {
    const LightSilhouettes::Loop& loop = silhouettes.loops[l];
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      const glm::dvec3 a(silhouettes.points[loop.first + i]);
      const glm::dvec3 b(silhouettes.points[loop.first + (i + 1) % loop.count]);
      const glm::dvec2 p = flat(a) - flat(target), q = flat(b) - flat(target);
      if ((p.y > 0) == (q.y > 0)) continue;
      const double side = p.x * q.y - p.y * q.x;
      turns += q.y > 0 ? side > 0 : -(side < 0);
    }
  }
  return turns;
}

int sumOfWindings(const LightSilhouettes& silhouettes, const glm::dvec2& source, const glm::dvec3& target) {
  int sum = 0;
  for (const auto& caster : silhouettes.casters) sum += winding(silhouettes, caster, source, target);
  return sum;
}

/// A torus on its rim, a wavy ring and a bent body: each hides parts of itself.
std::vector<Triangles> selfHiding() {
  Triangles ring = torus(1.0, 0.35);
  for (glm::vec3& p : ring.positions) p = glm::vec3(p.x, -p.z, p.y);
  Triangles screw = torus(1.0, 0.2);
  for (glm::vec3& p : screw.positions) {
    const double angle = std::atan2(p.z, p.x);
    p = glm::vec3(p.x, p.y + 0.7 * std::sin(3.0 * angle), p.z);
  }
  Triangles bent = sphere(4);
  for (glm::vec3& p : bent.positions) p.x += 1.2f * std::sin(3.0f * p.y);
  return {ring, screw, bent};
}

class Layers : public ::testing::Test {
 protected:
  static constexpr double kMinHeight = 1e-3;
  const LightPlane plane{scene::areaLightAimed({5, 3, 2}, {0, 0, 0}, 1.4, 1.4, {0.2, 0.1, 1.0}).value(), 10.0,
                         1e-4};
  const glm::dvec2 source{0.5, -0.5};

  LightSilhouettes silhouettesOf(const HalfEdgeMesh& mesh, LayerSplit split) const {
    const PlacedCaster caster{&mesh, glm::dmat4(1.0), 3};
    LightSilhouettes result;
    scene::lightSilhouettes({&caster, 1}, plane, source.x, source.y, kMinHeight, result, split);
    return result;
  }
};

TEST_F(Layers, CoverOnceEach) {
  for (const Triangles& triangles : selfHiding()) {
    const HalfEdgeMesh mesh = HalfEdgeMesh::build(triangles.mesh());
    const LightSilhouettes whole = silhouettesOf(mesh, LayerSplit::none);
    const LightSilhouettes layers = silhouettesOf(mesh, LayerSplit::layers);
    const LightSilhouettes outline = silhouettesOf(mesh, LayerSplit::outline);
    ASSERT_EQ(whole.casters.size(), 1u);
    ASSERT_GE(layers.casters.size(), 2u);
    ASSERT_EQ(outline.casters.size(), 1u);
    Random random(4);
    int doubled = 0, wrongFirst = 0, wrongOutline = 0, lost = 0, tooMuch = 0;
    constexpr int kTargets = 4000;
    for (int i = 0; i < kTargets; ++i) {
      const glm::dvec3 target = plane.fromWorld(random.inBox(1.5));
      const int all = sumOfWindings(whole, source, target);
      doubled += all > 1;
      wrongFirst += winding(layers, layers.casters[0], source, target) != (all > 0);
      wrongOutline += winding(outline, outline.casters[0], source, target) != (all > 0);
      for (std::size_t k = 1; k < layers.casters.size(); ++k) {
        const int turns = winding(layers, layers.casters[k], source, target);
        tooMuch += turns > (all > static_cast<int>(k)) || turns < 0;
        lost += k == 1 && all > 1 && turns == 0;
      }
    }
    EXPECT_GT(doubled, kTargets / 40);
    // Points are stored as floats: a target within 1e-7 of an edge may fall on either side.
    EXPECT_LE(wrongFirst, kTargets / 1000);
    EXPECT_LE(wrongOutline, kTargets / 1000);
    EXPECT_LE(tooMuch, kTargets / 1000);
    // Dropped slivers are each below 1 % of the first layer; on these smooth bodies there are few.
    EXPECT_LE(lost, doubled / 4);
  }
}

TEST_F(Layers, TheOutlineStaysClosedSeenFromElsewhereInTheLight) {
  for (const Triangles& triangles : selfHiding()) {
    const HalfEdgeMesh mesh = HalfEdgeMesh::build(triangles.mesh());
    const LightSilhouettes whole = silhouettesOf(mesh, LayerSplit::none);
    const LightSilhouettes outline = silhouettesOf(mesh, LayerSplit::outline);
    Random random(8);
    int covered = 0, leaks = 0;
    constexpr int kTargets = 4000;
    for (int i = 0; i < kTargets; ++i) {
      // A quarter of the light, as a sub-light sees it.
      const glm::dvec2 other = source + glm::dvec2(random.between(-0.5, 0.5), random.between(-0.5, 0.5));
      const glm::dvec3 target = plane.fromWorld(random.inBox(1.5) + glm::dvec3(-4, -2.4, -1.6));
      const int all = sumOfWindings(whole, other, target);
      covered += all > 0;
      leaks += all > 0 && sumOfWindings(outline, other, target) == 0;
    }
    EXPECT_GT(covered, kTargets / 20);
    // What was hidden behind the outline comes out at its border only, by the parallax of half a light: a
    // few per cent of what is covered.
    EXPECT_LE(leaks, covered / 10);
  }
}

TEST_F(Layers, ConvexCastersStayAsTheyAre) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(sphere(3).mesh());
  const LightSilhouettes whole = silhouettesOf(mesh, LayerSplit::none);
  const LightSilhouettes layers = silhouettesOf(mesh, LayerSplit::layers);
  EXPECT_EQ(layers.points, whole.points);
  EXPECT_EQ(layers.casters.size(), 1u);
  EXPECT_EQ(layers.casters[0].object, 3u);
}

TEST_F(Layers, AHoleStaysInItsLayer) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(torus(1.0, 0.3).mesh());
  const LightPlane above(scene::areaLightAimed({0, 9, 0}, {0, 0, 0}, 1, 1, {0, 0, 1}).value(), 10.0, 1e-4);
  const PlacedCaster caster{&mesh, glm::dmat4(1.0)};
  LightSilhouettes result;
  scene::lightSilhouettes({&caster, 1}, above, 0, 0, kMinHeight, result, LayerSplit::layers);
  ASSERT_EQ(result.casters.size(), 1u);
  EXPECT_EQ(result.casters[0].loopCount, 2u);
  EXPECT_EQ(winding(result, result.casters[0], {0, 0}, above.fromWorld({0, 0, 0})), 0);
  EXPECT_EQ(winding(result, result.casters[0], {0, 0}, above.fromWorld({1, 0, 0})), 1);
}

TEST_F(Layers, StandAlongsideTheEntryTheyCameFrom) {
  const HalfEdgeMesh hiding = HalfEdgeMesh::build(selfHiding()[0].mesh());
  const HalfEdgeMesh convex = HalfEdgeMesh::build(sphere(2).mesh());
  const std::vector<PlacedCaster> casters{{&hiding, glm::dmat4(1.0), 7}, {&convex, glm::dmat4(1.0), 8}};
  LightSilhouettes both, whole, layers;
  scene::lightSilhouettes(casters, plane, 0, 0, kMinHeight, both, LayerSplit::alongside);
  scene::lightSilhouettes(casters, plane, 0, 0, kMinHeight, whole, LayerSplit::none);
  scene::lightSilhouettes(casters, plane, 0, 0, kMinHeight, layers, LayerSplit::layers);
  ASSERT_EQ(both.casters.size(), whole.casters.size() + layers.casters.size() - 1);
  EXPECT_EQ(both.casters[0].loopCount, whole.casters[0].loopCount);
  EXPECT_EQ(both.casters[0].layerCount, layers.casters.size() - 1);
  for (std::size_t k = 1; k <= both.casters[0].layerCount; ++k) {
    EXPECT_EQ(both.casters[k].object, 7u);
    EXPECT_EQ(both.casters[k].layerCount, 0u);
    EXPECT_EQ(both.casters[k].loopCount, layers.casters[k - 1].loopCount);
  }
  EXPECT_EQ(both.casters.back().object, 8u);
  EXPECT_EQ(both.casters.back().layerCount, 0u);
}

TEST_F(Layers, AreKeptByTheCache) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(selfHiding()[0].mesh());
  const std::vector<PlacedCaster> casters{{&mesh, glm::dmat4(1.0), 0, 1}, {&mesh, glm::dmat4(1.0), 1, 2}};
  scene::CasterSilhouettes extracted;
  scene::LightSilhouetteCache cache;
  LightSilhouettes anew;
  for (const LayerSplit split :
       {LayerSplit::layers, LayerSplit::outline, LayerSplit::alongside, LayerSplit::none}) {
    const auto& cached = cache.update(extracted, casters, plane, source.x, source.y, kMinHeight, split);
    EXPECT_EQ(cache.counters().placed, 2u);
    scene::lightSilhouettes(casters, plane, source.x, source.y, kMinHeight, anew, split);
    EXPECT_EQ(cached.points, anew.points);
    EXPECT_EQ(cached.casters.size(), anew.casters.size());
  }
}

}  // namespace
}  // namespace halfshadow::testing
