// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Which parts count as convex: their silhouettes tell what they cover wherever they are cut.
#include <gtest/gtest.h>

#include "scene/half_edge_mesh.hpp"
#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {

std::vector<bool> convexParts(const Triangles& triangles) {
  std::vector<bool> convex;
  const scene::HalfEdgeMesh mesh = scene::HalfEdgeMesh::build(triangles.mesh());
  for (const scene::CasterPart& part : mesh.parts()) convex.push_back(part.convex);
  return convex;
}

TEST(ConvexParts, AreToldFromHollowOnes) {
  EXPECT_EQ(convexParts(cube()), std::vector{true});
  EXPECT_EQ(convexParts(sphere(2)), std::vector{true});
  EXPECT_EQ(convexParts(capsule()), std::vector{true});
  EXPECT_EQ(convexParts(torus(1.0, 0.3)), std::vector{false});
}

TEST(ConvexParts, SheetsMustBeEven) {
  EXPECT_EQ(convexParts(sheet(4)), std::vector{true});
  EXPECT_EQ(convexParts(sheet(4, 0.3)), std::vector{false});
  EXPECT_EQ(convexParts(fold()), std::vector{false});
}

TEST(ConvexParts, ShallowDentsDoNotCountDeepOnesDo) {
  for (const auto& [depth, convex] : {std::pair{0.005f, true}, {0.3f, false}}) {
    Triangles ball = sphere(2);
    for (glm::vec3& p : ball.positions) {
      if (p.y > 0.95f) p.y -= depth;
    }
    EXPECT_EQ(convexParts(ball), std::vector{convex}) << depth;
  }
}

TEST(ConvexParts, EachIsJudgedAlone) {
  Triangles both = cube();
  both.append(torus(1.0, 0.3), {5, 0, 0});
  const std::vector<bool> convex = convexParts(both);
  ASSERT_EQ(convex.size(), 2u);
  EXPECT_NE(convex[0], convex[1]);
}

TEST(ConvexParts, FollowTheirPositions) {
  Triangles ball = sphere(2);
  scene::TriangleMesh mesh = ball.mesh();
  scene::HalfEdgeMesh halfEdges = scene::HalfEdgeMesh::build(mesh);
  ASSERT_TRUE(halfEdges.parts()[0].convex);
  for (glm::vec3& p : mesh.positions) {
    if (p.y > 0.9f) p.y = 0.2f;
  }
  halfEdges.updatePositions(mesh);
  EXPECT_FALSE(halfEdges.parts()[0].convex);
}

}  // namespace
}  // namespace halfshadow::testing
