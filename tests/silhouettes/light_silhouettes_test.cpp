// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/light_silhouettes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {
using scene::HalfEdgeMesh;
using scene::LightPlane;
using scene::LightSilhouettes;
using scene::PlacedCaster;

scene::AreaLight lightOver(double halfSize) {
  return scene::areaLightAimed({1, 9, 2}, {0, 0, 0}, 2 * halfSize, 2 * halfSize, {0.2, 0.1, 1.0}).value();
}

/// Turns of the loops around the ray from the source point through `target`, both in (a, b, h).
int windingNumber(const LightSilhouettes& silhouettes, const glm::dvec2& source, const glm::dvec3& target) {
  const auto projected = [&](const glm::dvec3& p) { return (glm::dvec2(p) - source) / p.z; };
  const glm::dvec2 center = projected(target);
  int turns = 0;
  for (const LightSilhouettes::Loop& loop : silhouettes.loops) {
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      const glm::dvec2 p = projected(glm::dvec3(silhouettes.points[loop.first + i])) - center;
      const glm::dvec2 q =
          projected(glm::dvec3(silhouettes.points[loop.first + (i + 1) % loop.count])) - center;
      if ((p.y > 0) == (q.y > 0)) continue;
      const double cross = p.x * q.y - p.y * q.x;
      if (q.y > 0 && cross > 0) ++turns;
      if (q.y <= 0 && cross < 0) --turns;
    }
  }
  return turns;
}

/// Occluding faces between the source point and infinity on the ray through `target`, with h >= minHeight.
int layersHit(const PlacedCaster& caster, const LightPlane& plane, const glm::dvec2& source,
              const glm::dvec3& target, double minHeight) {
  const glm::dvec3 origin(source, 0.0);
  const glm::dvec3 direction = target - origin;
  const bool mirrored = glm::determinant(glm::dmat3(caster.worldFromObject)) < 0.0;
  int count = 0;
  for (const glm::uvec3& face : caster.mesh->faces()) {
    glm::dvec3 corner[3];
    for (int k = 0; k < 3; ++k) {
      const glm::dvec4 object(glm::dvec3(caster.mesh->positions()[face[k]]), 1.0);
      corner[k] = plane.fromWorld(glm::dvec3(caster.worldFromObject * object)) - origin;
    }
    const double u = glm::dot(direction, glm::cross(corner[1], corner[2]));
    const double v = glm::dot(direction, glm::cross(corner[2], corner[0]));
    const double w = glm::dot(direction, glm::cross(corner[0], corner[1]));
    if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) continue;
    const double volume = glm::dot(corner[0], glm::cross(corner[1], corner[2]));
    const double along = volume / (u + v + w);
    if (along * direction.z < minHeight) continue;
    // (a, b, h) is right-handed, like the world. Sheets count from both sides.
    count += !caster.mesh->parts()[0].closed || (volume < 0.0) != mirrored;
  }
  return count;
}

/// Compares turns and rays for random targets below the light. Returns how many targets were covered.
int expectCoverageAgrees(const PlacedCaster& caster, const LightPlane& plane, const glm::dvec2& source,
                         double minHeight, int targets, double reach) {
  LightSilhouettes silhouettes;
  scene::lightSilhouettes({&caster, 1}, plane, source.x, source.y, minHeight, silhouettes);
  Random random(11);
  int covered = 0, wrong = 0;
  for (int i = 0; i < targets; ++i) {
    const glm::dvec3 world = random.inBox(reach);
    const glm::dvec3 target = plane.fromWorld(world);
    if (target.z < 0.05) continue;
    const int layers = layersHit(caster, plane, source, target, minHeight);
    covered += layers > 0;
    wrong += windingNumber(silhouettes, source, target) != layers;
  }
  // A random target within float rounding (1e-7) of an outline has a chance below 1e-4.
  EXPECT_LE(wrong, targets / 2000);
  return covered;
}

TEST(LightSilhouettes, CoverWhatRaysHitWhateverTheTransform) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(torus(1.0, 0.4).mesh());
  const LightPlane plane(lightOver(0.7), 10.0, 1e-4);
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1, 2, 3));
  for (const glm::dvec3& scale :
       {glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, 1), glm::dvec3(0.3, 2.0, 1.1), glm::dvec3(-2.0, -0.5, -1.0)}) {
    const PlacedCaster caster{.mesh = &mesh, .worldFromObject = glm::scale(turned, scale)};
    EXPECT_GT(expectCoverageAgrees(caster, plane, {0.5, -0.5}, 1e-3, 4000, 2.0), 200);
  }
}

TEST(LightSilhouettes, LoopsRunCounterClockwise) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(sphere(2).mesh());
  const LightPlane plane(lightOver(1.0), 10.0, 1e-4);
  for (const double x : {1.0, -1.0}) {
    LightSilhouettes result;
    const PlacedCaster caster{&mesh, glm::scale(glm::dmat4(1.0), glm::dvec3(x, 1, 1))};
    scene::lightSilhouettes({&caster, 1}, plane, 0, 0, 1e-3, result);
    ASSERT_EQ(result.loops.size(), 1u);
    double area = 0.0;
    for (std::uint32_t i = 0; i < result.loops[0].count; ++i) {
      const glm::dvec3 p(result.points[i]), q(result.points[(i + 1) % result.loops[0].count]);
      area += (p.x * q.y - p.y * q.x) / (p.z * q.z) / 2;
    }
    EXPECT_GT(area, 0.0);
  }
}

TEST(LightSilhouettes, ShiftedAndScaledWorldsGiveTheSameLoops) {
  Triangles triangles;
  triangles.append(torus(1.0, 0.4), {0, 0, 0});
  triangles.append(cube(), {2.5f, 0.5f, 1});
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(triangles.mesh());
  const auto loops = [&](double scale, const glm::dvec3& shift) {
    scene::AreaLight light = lightOver(0.7);
    light.centerWorld = light.centerWorld * scale + shift;
    light.halfU *= scale;
    light.halfV *= scale;
    const glm::dmat4 world = glm::scale(glm::translate(glm::dmat4(1.0), shift), glm::dvec3(scale)) *
                             glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(0, 1, 1));
    const PlacedCaster caster{&mesh, world};
    LightSilhouettes result;
    scene::lightSilhouettes({&caster, 1}, LightPlane(light, 10.0 * scale, 1e-4 * scale), 0.5, 0.5, 1e-3,
                            result);
    return result;
  };
  const LightSilhouettes base = loops(1.0, {0, 0, 0});
  ASSERT_GT(base.points.size(), 50u);
  for (const auto& [scale, shift] :
       {std::pair{1.0, 1e4}, {1e-3, 0.0}, {1e3, 0.0}, {1e-3, 10.0}, {1e3, 1e7}}) {
    const LightSilhouettes other = loops(scale, glm::dvec3(shift, -shift, shift));
    ASSERT_EQ(other.points.size(), base.points.size()) << scale << " " << shift;
    for (std::size_t i = 0; i < base.points.size(); ++i) {
      EXPECT_LT(glm::length(other.points[i] - base.points[i]), 1e-4f) << i;
    }
  }
}

TEST(LightSilhouettes, CastersThroughTheLightPlaneAreCut) {
  const scene::AreaLight light = scene::areaLightAimed({0, 0, 0}, {0, -1, 0}, 1.0, 1.0, {0, 0, 1}).value();
  const LightPlane plane(light, 10.0, 1e-4);
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(sphere(3).mesh());
  const PlacedCaster beside{&mesh, glm::translate(glm::dmat4(1.0), glm::dvec3(2.5, -0.2, 0.4))};
  LightSilhouettes result;
  constexpr double kMinHeight = 1e-3;
  scene::lightSilhouettes({&beside, 1}, plane, 0.5, 0.5, kMinHeight, result);
  ASSERT_EQ(result.loops.size(), 1u);
  int onCut = 0;
  for (const glm::dvec3& p : result.points) {
    EXPECT_GE(p.z, static_cast<float>(kMinHeight) * 0.999f);
    onCut += p.z < kMinHeight * 1.001;
  }
  EXPECT_GT(onCut, 5);  // along the cut through the sphere's lit side
  EXPECT_GT(expectCoverageAgrees(beside, plane, {0.5, 0.5}, kMinHeight, 20000, 5.0), 100);
  // Wholly behind the light nothing is cast.
  const PlacedCaster behind{&mesh, glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 1.5, 0.4))};
  scene::lightSilhouettes({&behind, 1}, plane, 0.5, 0.5, kMinHeight, result);
  EXPECT_TRUE(result.casters.empty());
  EXPECT_TRUE(result.points.empty());
}

TEST(LightSilhouettes, AShadeAroundTheLightThroughItsPlaneKeepsItsShadow) {
  const scene::AreaLight light = scene::areaLightAimed({0, 0, 0}, {0, -1, 0}, 0.2, 0.2, {0, 0, 1}).value();
  const LightPlane plane(light, 10.0, 1e-4);
  // A solid ring: rays leave through its opening below, all others are stopped.
  const HalfEdgeMesh ring = HalfEdgeMesh::build(torus(1.0, 0.3).mesh());
  const PlacedCaster solid{&ring, glm::scale(glm::dmat4(1.0), glm::dvec3(1, 2, 1))};
  const int bySolid = expectCoverageAgrees(solid, plane, {0.5, -0.5}, 1e-3, 4000, 4.0);
  EXPECT_GT(bySolid, 500);
  // A tube without ends.
  Triangles tube;
  constexpr std::uint32_t kSides = 24;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 6.28318530717958648 * i / kSides;
    for (const double y : {-0.8, 0.6}) tube.addVertex({std::cos(angle), y, std::sin(angle)});
  }
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % kSides);
    tube.addQuad(a, a + 1, b + 1, b);
  }
  const HalfEdgeMesh shade = HalfEdgeMesh::build(tube.mesh());
  ASSERT_FALSE(shade.parts()[0].closed);
  const PlacedCaster sheetCaster{&shade, glm::dmat4(1.0)};
  EXPECT_GT(expectCoverageAgrees(sheetCaster, plane, {0.5, -0.5}, 1e-3, 4000, 4.0), 500);
}

TEST(LightSilhouettes, ALightInsideACasterIsToldAndHasNoLoop) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(sphere(2).mesh());
  const LightPlane plane(lightOver(0.1), 10.0, 1e-4);
  const PlacedCaster around{
      .mesh = &mesh, .worldFromObject = glm::translate(glm::dmat4(1.0), glm::dvec3(1, 9, 2)), .object = 5};
  LightSilhouettes result;
  scene::lightSilhouettes({&around, 1}, plane, 0, 0, 1e-3, result);
  ASSERT_EQ(result.casters.size(), 1u);
  EXPECT_TRUE(result.casters[0].enclosesLight);
  EXPECT_EQ(result.casters[0].object, 5u);
  EXPECT_EQ(result.casters[0].loopCount, 0u);
}

TEST(LightSilhouettes, APointLightHasFiniteCoordinates) {
  scene::AreaLight light = lightOver(0.0);
  const LightPlane plane(light, 10.0, 1e-4);
  EXPECT_NEAR(glm::length(plane.halfU), 1e-4, 1e-12);
  EXPECT_NEAR(glm::length(plane.halfV), 1e-4, 1e-12);
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(sphere(2).mesh());
  const PlacedCaster caster{&mesh, glm::dmat4(1.0)};
  EXPECT_GT(expectCoverageAgrees(caster, plane, {0, 0}, 1e-3, 4000, 2.0), 200);
}

}  // namespace
}  // namespace halfshadow::testing
