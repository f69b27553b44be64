// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <functional>

#include "layer_count.hpp"
#include "scene/silhouette_check.hpp"
#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {
using scene::HalfEdgeMesh;
using scene::Silhouette;

struct Named {
  const char* name;
  std::function<Triangles()> make;
};

class LoopsOf : public ::testing::TestWithParam<Named> {};

/// Many lights, many directions: what the loops say against what rays hit. Returns the directions compared.
int expectLoopsAgreeWithRays(const HalfEdgeMesh& mesh, int lights, int directions, double reach,
                             unsigned seed) {
  Random random(seed);
  Silhouette silhouette;
  int compared = 0;
  for (int l = 0; l < lights; ++l) {
    const glm::dvec3 light = random.inBox(reach);
    scene::extractSilhouette(mesh, light, silhouette);
    EXPECT_EQ(scene::silhouetteProblem(mesh, silhouette), "");
    for (int d = 0; d < directions; ++d) {
      // Half of the directions go towards the mesh, where there is something to count.
      const glm::dvec3 from = d % 2 == 0 ? random.direction() : glm::normalize(random.inBox(1.2) - light);
      const glm::dvec3 to = random.direction();
      for (std::uint32_t part = 0; part < mesh.parts().size(); ++part) {
        for (const Side side : {Side::towards, Side::away}) {
          if (side == Side::away && mesh.parts()[part].closed) continue;
          const auto a = layersByRay(mesh, part, light, from, side);
          const auto b = layersByRay(mesh, part, light, to, side);
          if (!a || !b) continue;
          EXPECT_EQ(layerDifference(mesh, silhouette, part, light, from, to, side), *a - *b)
              << "light " << l << ", direction " << d << ", part " << part;
          ++compared;
        }
      }
    }
  }
  return compared;
}

TEST_P(LoopsOf, AgreeWithRaysFromRandomPoints) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(GetParam().make().mesh());
  // Points up to 3 units away, so that some lie inside the caster.
  const int compared = expectLoopsAgreeWithRays(mesh, 60, 40, 3.0, 7);
  // A ray comes within 1e-6 of an edge a handful of times in a thousand faces.
  EXPECT_GE(compared, 60 * 40 * 95 / 100);
}

INSTANTIATE_TEST_SUITE_P(Silhouettes, LoopsOf,
                         ::testing::Values(Named{"cube", cube}, Named{"sphere", [] { return sphere(3); }},
                                           Named{"torus", [] { return torus(1.0, 0.4); }},
                                           Named{"capsule", capsule}, Named{"sheet", [] { return sheet(1); }},
                                           Named{"bentSheet", [] { return sheet(12, 1.5); }},
                                           Named{"fold", fold}, Named{"moebius", moebius}),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(Loops, ACubeSeenFromACornerHasOneHexagon) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(cube().mesh());
  Silhouette silhouette;
  scene::extractSilhouette(mesh, {5, 6, 7}, silhouette);
  ASSERT_EQ(silhouette.loops.size(), 1u);
  EXPECT_EQ(silhouette.loops[0].count, 6u);
  scene::extractSilhouette(mesh, {0, 9, 0}, silhouette);
  ASSERT_EQ(silhouette.loops.size(), 1u);
  EXPECT_EQ(silhouette.loops[0].count, 4u);
}

TEST(Loops, ATorusSeenAlongItsAxisHasAnOutlineAndAHole) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(torus(1.0, 0.3).mesh());
  Silhouette silhouette;
  scene::extractSilhouette(mesh, {0.01, 20, 0.02}, silhouette);
  EXPECT_EQ(silhouette.loops.size(), 2u);
  ASSERT_EQ(silhouette.parts.size(), 1u);
  EXPECT_TRUE(mesh.parts()[0].closed);
}

TEST(Loops, APointInsideAClosedCasterSeesNoOutline) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(sphere(2).mesh());
  Silhouette silhouette;
  scene::extractSilhouette(mesh, {0.1, -0.2, 0.3}, silhouette);
  EXPECT_TRUE(silhouette.loops.empty());
  ASSERT_EQ(silhouette.parts.size(), 1u);
  EXPECT_TRUE(silhouette.parts[0].enclosesLight);
  // Inside the box around the torus and in its hole, but not inside the torus.
  const HalfEdgeMesh ring = HalfEdgeMesh::build(torus(1.0, 0.3).mesh());
  scene::extractSilhouette(ring, {0.05, 0.02, 0.0}, silhouette);
  ASSERT_EQ(silhouette.parts.size(), 1u);
  EXPECT_FALSE(silhouette.parts[0].enclosesLight);
  scene::extractSilhouette(ring, {1.0, 0.02, 0.05}, silhouette);
  ASSERT_EQ(silhouette.parts.size(), 1u);
  EXPECT_TRUE(silhouette.parts[0].enclosesLight);
}

TEST(Loops, TheSidesOfASheetAreApart) {
  Silhouette silhouette;
  const HalfEdgeMesh flat = HalfEdgeMesh::build(sheet(4).mesh());
  EXPECT_FALSE(flat.parts()[0].closed);
  for (const double y : {3.0, -3.0}) {
    scene::extractSilhouette(flat, {0.2, y, 0.1}, silhouette);
    ASSERT_EQ(silhouette.parts.size(), 1u);
    EXPECT_EQ(silhouette.parts[0].turnedAway, y < 0);
    ASSERT_EQ(silhouette.loops.size(), 1u);
    EXPECT_EQ(silhouette.loops[0].count, 16u);
  }
  // One square looks up, the other forward; from above and behind only one is seen from its front.
  const HalfEdgeMesh bent = HalfEdgeMesh::build(fold().mesh());
  scene::extractSilhouette(bent, {0.1, 4, -3}, silhouette);
  ASSERT_EQ(silhouette.parts.size(), 2u);
  EXPECT_NE(silhouette.parts[0].turnedAway, silhouette.parts[1].turnedAway);
  EXPECT_EQ(silhouette.loops.size(), 2u);
  // Seen from inside the fold its outline would cover receivers before the squares: each has its own.
  scene::extractSilhouette(bent, {0.1, 4, 3}, silhouette);
  ASSERT_EQ(silhouette.parts.size(), 2u);
  for (const Silhouette::Part& part : silhouette.parts) EXPECT_FALSE(part.turnedAway);
  for (const Silhouette::Loop& loop : silhouette.loops) EXPECT_EQ(loop.count, 4u);
  // From outside the fold is a ridge, and the outline is that of both.
  scene::extractSilhouette(bent, {0.1, -3, -4}, silhouette);
  ASSERT_EQ(silhouette.parts.size(), 1u);
  EXPECT_TRUE(silhouette.parts[0].turnedAway);
  EXPECT_EQ(silhouette.loops[0].count, 6u);
}

TEST(Loops, ClustersDecideMostFacesOfAFineSphere) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(sphere(5).mesh());
  Silhouette silhouette;
  scene::extractSilhouette(mesh, {9, 20, 4}, silhouette);
  // 20,480 faces in clusters of 16, about 0.1 across: those within 0.1 of the outline's great circle, a tenth
  // of the sphere, stay undecided. A quarter leaves room for clusters that are not compact.
  EXPECT_LT(silhouette.counters.facesTested, mesh.faces().size() / 4);
  EXPECT_GT(silhouette.counters.clustersSkipped, mesh.clusters().size() * 3 / 4);
  EXPECT_LT(silhouette.counters.edgesVisited, mesh.edges().size() / 2);
  EXPECT_GT(silhouette.loops[0].count, 100u);
}

TEST(Loops, ClustersNeverDecideWrongly) {
  Random random(3);
  for (const Triangles& triangles : {sphere(3), torus(1.0, 0.4), sheet(12, 1.5), capsule()}) {
    const HalfEdgeMesh mesh = HalfEdgeMesh::build(triangles.mesh());
    Silhouette silhouette;
    for (int l = 0; l < 300; ++l) {
      const glm::dvec3 light = random.inBox(l % 2 == 0 ? 1.5 : 50.0);
      scene::extractSilhouette(mesh, light, silhouette);
      for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
        const glm::uvec3& face = mesh.faces()[f];
        const glm::dvec3 a(mesh.positions()[face.x]), b(mesh.positions()[face.y]),
            c(mesh.positions()[face.z]);
        const double distance = glm::dot(glm::normalize(glm::cross(b - a, c - a)), light - a);
        // Float planes are good to some 1e-7 of the distances involved; faces seen that edge-on may go
        // either way.
        if (std::abs(distance) < 1e-5 * (1.0 + glm::length(light))) continue;
        EXPECT_EQ(silhouette.facing[f] != 0, distance > 0.0) << f;
      }
    }
  }
}

TEST(Loops, FollowMovedPositions) {
  Triangles triangles = sphere(2);
  HalfEdgeMesh mesh = HalfEdgeMesh::build(triangles.mesh());
  for (glm::vec3& p : triangles.positions) p = glm::vec3(2.5f * p.x + 40.0f, p.y * 0.4f, p.z + 0.3f * p.x);
  scene::TriangleMesh moved = triangles.mesh();
  mesh.updatePositions(moved);
  const HalfEdgeMesh built = HalfEdgeMesh::build(moved);
  Silhouette a, b;
  scene::extractSilhouette(mesh, {44, 9, 2}, a);
  scene::extractSilhouette(built, {44, 9, 2}, b);
  EXPECT_EQ(scene::silhouetteProblem(mesh, a), "");
  ASSERT_EQ(a.loops.size(), 1u);
  ASSERT_EQ(b.loops.size(), 1u);
  EXPECT_EQ(a.loops[0].count, b.loops[0].count);
}

}  // namespace
}  // namespace halfshadow::testing
