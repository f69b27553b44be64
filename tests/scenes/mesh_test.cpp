// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace halfshadow::scene {
namespace {

const std::vector<float> kTetrahedron = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::uint32_t> kTetrahedronIndices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

Result<TriangleMesh> build(const std::vector<float>& positions, const std::vector<std::uint32_t>& indices) {
  return buildMesh({.positions = positions.data(),
                    .vertexCount = static_cast<std::uint32_t>(positions.size() / 3),
                    .indices = indices.data(),
                    .indexCount = indices.size()});
}

TEST(BuildMesh, KeepsAClosedMeshAsItIs) {
  const auto mesh = build(kTetrahedron, kTetrahedronIndices);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->triangleCount(), 4u);
  EXPECT_TRUE(mesh->statistics.closed());
  EXPECT_EQ(mesh->statistics.nonManifoldEdges, 0u);
  EXPECT_EQ(mesh->statistics.degenerateTrianglesDropped, 0u);
}

TEST(BuildMesh, CountsBoundaryEdgesOfAnOpenMesh) {
  const auto mesh = build(kTetrahedron, {0, 2, 1, 0, 1, 3, 0, 3, 2});
  ASSERT_TRUE(mesh.ok());
  EXPECT_FALSE(mesh->statistics.closed());
  EXPECT_EQ(mesh->statistics.boundaryEdges, 3u);
}

TEST(BuildMesh, DropsZeroAreaAndDuplicateTriangles) {
  std::vector<std::uint32_t> indices = kTetrahedronIndices;
  indices.insert(indices.end(), {0, 0, 1});  // repeated index
  indices.insert(indices.end(), {2, 1, 0});  // the first triangle, rotated
  const auto mesh = build(kTetrahedron, indices);
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->triangleCount(), 4u);
  EXPECT_EQ(mesh->statistics.degenerateTrianglesDropped, 1u);
  EXPECT_EQ(mesh->statistics.duplicateTrianglesDropped, 1u);
  EXPECT_TRUE(mesh->statistics.closed());
}

TEST(BuildMesh, DropsCollinearTriangles) {
  const auto mesh = build({0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0}, {0, 1, 2, 0, 1, 3});
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->triangleCount(), 1u);
  EXPECT_EQ(mesh->statistics.degenerateTrianglesDropped, 1u);
}

TEST(BuildMesh, KeepsTheBackOfATwoSidedTriangle) {
  const auto mesh = build(kTetrahedron, {0, 1, 2, 0, 2, 1});
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->triangleCount(), 2u);
  EXPECT_TRUE(mesh->statistics.closed());
}

TEST(BuildMesh, CountsEdgesWithMoreThanTwoTriangles) {
  const auto mesh = build({0, 0, 0, 0, 0, 1, 1, 0, 0, -1, 0, 0, 0, 1, 0}, {0, 1, 2, 1, 0, 3, 0, 1, 4});
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->statistics.nonManifoldEdges, 1u);
}

TEST(BuildMesh, WeldsEqualPositionsForAdjacencyOnly) {
  // The tetrahedron with three vertices of its own per triangle; -0 equals 0.
  std::vector<float> positions;
  for (const std::uint32_t index : kTetrahedronIndices) {
    for (int axis = 0; axis < 3; ++axis) positions.push_back(kTetrahedron[index * 3 + axis]);
  }
  positions[0] = -0.0f;
  const auto mesh = buildMesh({.positions = positions.data(), .vertexCount = 12});
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->positions.size(), 12u);
  EXPECT_EQ(mesh->weldedVertex[3], 0u);
  EXPECT_TRUE(mesh->statistics.closed());
}

TEST(BuildMesh, ReadsInterleavedPositionsAndKeepsAttributes) {
  const std::vector<float> interleaved = {0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 0, 1, 0, 9, 9};
  const std::vector<float> normals = {0, 0, 1, 0, 0, 1, 0, 0, 1}, texcoords = {0, 0, 1, 0, 0, 1};
  const auto mesh = buildMesh({.positions = interleaved.data(),
                               .positionStrideBytes = 20,
                               .vertexCount = 3,
                               .normals = normals.data(),
                               .texcoords = texcoords.data()});
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->positions[2], glm::vec3(0, 1, 0));
  EXPECT_EQ(mesh->normals[1], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh->texcoords[2], glm::vec2(0, 1));
}

TEST(BuildMesh, NamesTheFirstOffendingElement) {
  const auto range = build(kTetrahedron, {0, 1, 7});
  ASSERT_FALSE(range.ok());
  EXPECT_EQ(range.error().code, ErrorCode::invalidMesh);
  EXPECT_NE(range.error().message.find("index 2 is 7"), std::string::npos) << range.error().message;

  std::vector<float> positions = kTetrahedron;
  positions[7] = std::numeric_limits<float>::quiet_NaN();
  const auto nan = build(positions, kTetrahedronIndices);
  ASSERT_FALSE(nan.ok());
  EXPECT_EQ(nan.error().code, ErrorCode::invalidMesh);
  EXPECT_NE(nan.error().message.find("vertex 2"), std::string::npos) << nan.error().message;

  const auto count = build(kTetrahedron, {0, 1, 2, 3});
  ASSERT_FALSE(count.ok());
  EXPECT_EQ(count.error().code, ErrorCode::invalidMesh);
}

TEST(BuildMesh, SaysWhenNothingIsLeft) {
  const auto nothing = build(kTetrahedron, {1, 1, 1});
  ASSERT_FALSE(nothing.ok());
  EXPECT_EQ(nothing.error().code, ErrorCode::emptyScene);
  const auto empty = buildMesh({});
  ASSERT_FALSE(empty.ok());
  EXPECT_EQ(empty.error().code, ErrorCode::emptyScene);
}

}  // namespace
}  // namespace halfshadow::scene
