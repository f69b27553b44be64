// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/convex_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "scene/bounds.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::scene {
namespace {

TriangleMesh meshOf(const std::vector<glm::vec3>& points) {
  TriangleMesh mesh;
  mesh.positions = points;
  for (std::uint32_t i = 0; i < points.size(); ++i) mesh.indices.push_back(i);
  while (mesh.indices.size() % 3 != 0) mesh.indices.push_back(0);
  return mesh;
}

/// How far the mesh reaches beyond the points along any of many directions, and the points beyond the mesh;
/// shares of its size.
struct Reach {
  double meshBeyond = 0.0, pointsBeyond = 0.0;
};
Reach compare(const TriangleMesh& mesh, const std::vector<glm::dvec3>& points) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const double size = boundsOf(mesh).radius();
  Reach reach;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    double ofMesh = -1e300, ofPoints = -1e300;
    for (const std::uint32_t v : mesh.indices)
      ofMesh = std::max(ofMesh, glm::dot(direction, glm::dvec3(mesh.positions[v])));
    for (const glm::dvec3& p : points) ofPoints = std::max(ofPoints, glm::dot(direction, p));
    reach.meshBeyond = std::max(reach.meshBeyond, (ofMesh - ofPoints) / size);
    reach.pointsBeyond = std::max(reach.pointsBeyond, (ofPoints - ofMesh) / size);
  }
  return reach;
}

std::vector<glm::vec3> sphere(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<glm::vec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(glm::normalize(glm::vec3(normal(random), normal(random), normal(random))));
  return points;
}

TEST(EnclosingPoints, OfABoxOfManyVerticesAreItsCorners) {
  std::vector<glm::vec3> grid;
  for (int x = 0; x <= 8; ++x) {
    for (int y = 0; y <= 8; ++y) {
      for (int z = 0; z <= 8; ++z) grid.push_back({x, y, z});
    }
  }
  const auto points = enclosingPoints(meshOf(grid)).points;
  EXPECT_EQ(points.size(), 8u);
  EXPECT_EQ(compare(meshOf(grid), points).meshBeyond, 0.0);
}

TEST(EnclosingPoints, OfFlatMeshesAreTheirOutline) {
  std::vector<glm::vec3> grid;
  for (int x = 0; x <= 30; ++x) {
    for (int z = 0; z <= 30; ++z) grid.push_back({x, 2, z});
  }
  EXPECT_EQ(enclosingPoints(meshOf(grid)).points.size(), 4u);
  // Along a line, and in one place.
  std::vector<glm::vec3> line;
  for (int i = 0; i < 20; ++i) line.push_back({i, 2 * i, -i});
  EXPECT_EQ(compare(meshOf(line), enclosingPoints(meshOf(line)).points).meshBeyond, 0.0);
  EXPECT_FALSE(enclosingPoints(meshOf(std::vector<glm::vec3>(20, glm::vec3(1)))).points.empty());
}

TEST(EnclosingPoints, OfRandomCloudsReachExactlyAsFar) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int round = 0; round < 30; ++round) {
    std::vector<glm::vec3> points;
    const float thin = round % 3 == 0 ? 1e-3f : 1.0f;
    for (int i = 0; i < 400; ++i) points.push_back({unit(random), thin * unit(random), unit(random)});
    const auto enclosing = enclosingPoints(meshOf(points)).points;
    EXPECT_LT(enclosing.size(), 200u);
    const Reach reach = compare(meshOf(points), enclosing);
    EXPECT_EQ(reach.meshBeyond, 0.0);
    EXPECT_EQ(reach.pointsBeyond, 0.0);
  }
}

TEST(EnclosingPoints, OfAFineSphereAreFewAndLieJustOutside) {
  const TriangleMesh fine = meshOf(sphere(9000, 2));
  const auto points = enclosingPoints(fine).points;
  EXPECT_LE(points.size(), 1100u);
  const Reach reach = compare(fine, points);
  EXPECT_LE(reach.meshBeyond, 0.0);
  EXPECT_LE(reach.pointsBeyond, 0.01);
  const TriangleMesh coarse = meshOf(sphere(600, 3));
  EXPECT_EQ(compare(coarse, enclosingPoints(coarse).points).meshBeyond, 0.0);
  EXPECT_EQ(compare(coarse, enclosingPoints(coarse).points).pointsBeyond, 0.0);
}

TEST(EnclosingPoints, OfTheBuiltinScenesBoundThemExactly) {
  for (const char* name : {"builtin:figure", "builtin:spheres27", "builtin:leaves", "builtin:mannequin"}) {
    const auto scene = scenes::openScene(name, {});
    ASSERT_TRUE(scene) << scene.error().message;
    for (const SceneObject& object : scene->objects) {
      const auto points = enclosingPoints(*object.mesh).points;
      const Reach reach = compare(*object.mesh, points);
      EXPECT_LE(reach.meshBeyond, 1e-10) << name << " " << object.name;
      EXPECT_LE(reach.pointsBeyond, 0.01) << name << " " << object.name << " " << points.size() << " of "
                                          << usedVertices(*object.mesh).size();
    }
  }
}

}  // namespace
}  // namespace halfshadow::scene
