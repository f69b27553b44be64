// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "layer_count.hpp"
#include "scene/silhouette_check.hpp"
#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {
using scene::CasterPart;
using scene::HalfEdgeMesh;
using scene::PartIssue;
using scene::Silhouette;

double signedVolume(const HalfEdgeMesh& mesh, const CasterPart& part) {
  double sum = 0.0;
  for (const glm::uvec3& f : mesh.faces().subspan(part.firstFace, part.faceCount)) {
    const glm::dvec3 a(mesh.positions()[f.x]), b(mesh.positions()[f.y]), c(mesh.positions()[f.z]);
    sum += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return sum;
}

/// From random points: loops proven closed, and layers as rays count them.
void expectSound(const HalfEdgeMesh& mesh, unsigned seed = 5) {
  Random random(seed);
  Silhouette silhouette;
  int compared = 0;
  for (int l = 0; l < 30; ++l) {
    const glm::dvec3 light = random.inBox(4.0);
    scene::extractSilhouette(mesh, light, silhouette);
    ASSERT_EQ(scene::silhouetteProblem(mesh, silhouette), "");
    for (int d = 0; d < 20; ++d) {
      const glm::dvec3 from = glm::normalize(random.inBox(1.2) - light), to = random.direction();
      for (std::uint32_t part = 0; part < mesh.parts().size(); ++part) {
        const auto a = layersByRay(mesh, part, light, from, Side::towards);
        const auto b = layersByRay(mesh, part, light, to, Side::towards);
        if (!a || !b) continue;
        EXPECT_EQ(layerDifference(mesh, silhouette, part, light, from, to, Side::towards), *a - *b);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 300);
}

/// The only part, closed and of the given volume.
void expectOneClosedPart(const HalfEdgeMesh& mesh, double volume, double tolerance = 1e-6) {
  ASSERT_EQ(mesh.parts().size(), 1u);
  const CasterPart& part = mesh.parts()[0];
  EXPECT_TRUE(part.closed) << describe(part);
  EXPECT_EQ(part.boundaryEdges, 0u);
  EXPECT_EQ(part.issue, PartIssue::none);
  EXPECT_NEAR(signedVolume(mesh, part), volume, tolerance);
}

TEST(Repair, CleanMeshesAreLeftAlone) {
  for (const Triangles& triangles : {cube(), sphere(2), torus(1.0, 0.4), capsule()}) {
    const HalfEdgeMesh mesh = HalfEdgeMesh::build(triangles.mesh());
    ASSERT_EQ(mesh.parts().size(), 1u);
    EXPECT_EQ(describe(mesh.parts()[0]), "");
    EXPECT_EQ(mesh.faces().size(), triangles.count());
    EXPECT_EQ(mesh.repairs().mergedVertices + mesh.repairs().backToBackFaces, 0u);
  }
}

/// A cube whose top is made of four triangles around a vertex, with `extra` vertices on two of its upper
/// edges that the sides do not know.
Triangles cubeWithTJunctions(int extra, float offset) {
  Triangles result = cube();
  // Replace the two triangles of the top by a fan around its middle.
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < result.indices.size(); i += 3) {
    bool top = true;
    for (std::size_t k = 0; k < 3; ++k) top = top && result.positions[result.indices[i + k]].y > 0.5f;
    if (!top)
      kept.insert(kept.end(), result.indices.begin() + static_cast<std::ptrdiff_t>(i),
                  result.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
  }
  result.indices = kept;
  std::vector<std::uint32_t> rim;
  const glm::vec3 corners[4] = {{-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}};
  for (int c = 0; c < 4; ++c) {
    rim.push_back(result.addVertex(corners[c]));
    for (int i = 1; c % 2 == 0 && i <= extra; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(extra + 1);
      rim.push_back(result.addVertex(glm::mix(corners[c], corners[(c + 1) % 4], t) +
                                     glm::vec3(0, i % 2 == 0 ? offset : -offset, 0)));
    }
  }
  const std::uint32_t middle = result.addVertex({0, 1, 0});
  for (std::size_t i = 0; i < rim.size(); ++i) result.addTriangle(middle, rim[i], rim[(i + 1) % rim.size()]);
  return result;
}

TEST(Repair, TJunctionsAreSplit) {
  for (const int extra : {1, 2, 7, 40}) {
    const scene::TriangleMesh source = cubeWithTJunctions(extra, 0.0f).mesh();
    EXPECT_FALSE(source.statistics.closed());
    const HalfEdgeMesh mesh = HalfEdgeMesh::build(source);
    expectOneClosedPart(mesh, 8.0);
    EXPECT_EQ(mesh.parts()[0].repairedTJunctions, static_cast<std::uint32_t>(2 * extra));
    EXPECT_EQ(mesh.parts()[0].filledGaps, 0u);
    EXPECT_NE(describe(mesh.parts()[0]).find("T-junction"), std::string::npos);
    expectSound(mesh);
  }
  // Rounded positions: within 1e-4 of the edge's length.
  const HalfEdgeMesh rounded = HalfEdgeMesh::build(cubeWithTJunctions(7, 1e-4f).mesh());
  expectOneClosedPart(rounded, 8.0, 1e-3);
}

TEST(Repair, CracksAreFilled) {
  // A thousandth of the edge's length apart: no T-junction any more, but nothing a light would shine through.
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(cubeWithTJunctions(5, 1e-3f).mesh());
  expectOneClosedPart(mesh, 8.0, 1e-2);
  EXPECT_EQ(mesh.parts()[0].filledGaps, 2u);
  expectSound(mesh);
}

TEST(Repair, SmallHolesAreFilledLargeOnesAreNot) {
  Triangles small = sphere(3);
  small.indices.resize(small.indices.size() - 3);
  const HalfEdgeMesh filled = HalfEdgeMesh::build(small.mesh());
  expectOneClosedPart(filled, 4.0 / 3.0 * 3.14159, 0.1);
  EXPECT_EQ(filled.parts()[0].filledGaps, 1u);
  expectSound(filled);

  Triangles large = cube();
  large.indices.resize(large.indices.size() - 6);
  const HalfEdgeMesh open = HalfEdgeMesh::build(large.mesh());
  ASSERT_EQ(open.parts().size(), 1u);
  EXPECT_FALSE(open.parts()[0].closed);
  EXPECT_EQ(open.parts()[0].issue, PartIssue::open);
  EXPECT_EQ(open.parts()[0].boundaryEdges, 4u);
  EXPECT_NE(describe(open.parts()[0]).find("open: 4 border edges"), std::string::npos);
  expectSound(open);
}

TEST(Repair, ASeamOfNearlyEqualVerticesIsMerged) {
  Triangles halves;
  const Triangles whole = sphere(3);
  // Each triangle gets vertices of its own, a few rounding steps off.
  Random random(1);
  for (const std::uint32_t i : whole.indices) {
    halves.indices.push_back(halves.addVertex(whole.positions[i] + glm::vec3(random.inBox(2e-7))));
  }
  const scene::TriangleMesh source = halves.mesh();
  EXPECT_GT(source.statistics.boundaryEdges, 500u);
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(source);
  expectOneClosedPart(mesh, 4.0 / 3.0 * 3.14159, 0.1);
  EXPECT_GT(mesh.repairs().mergedVertices, 500u);
  expectSound(mesh);
}

TEST(Repair, InconsistentWindingIsMadeToAgree) {
  Random random(2);
  for (const Triangles& clean : {cube(), torus(1.0, 0.4), sphere(2)}) {
    const double volume =
        signedVolume(HalfEdgeMesh::build(clean.mesh()), HalfEdgeMesh::build(clean.mesh()).parts()[0]);
    Triangles triangles = clean;
    std::uint32_t flipped = 0;
    for (std::size_t t = 0; t < triangles.count(); ++t) {
      if (random.between(0, 1) > 0.4) continue;
      triangles.flip(t);
      ++flipped;
    }
    ASSERT_GT(flipped, 0u);
    const HalfEdgeMesh mesh = HalfEdgeMesh::build(triangles.mesh());
    expectOneClosedPart(mesh, volume);
    EXPECT_EQ(mesh.parts()[0].flippedFaces, flipped);
    EXPECT_FALSE(mesh.parts()[0].inward);
    expectSound(mesh);
  }
}

TEST(Repair, AnInwardPartIsTurnedAndAroundALightInside) {
  Triangles room = cube();
  for (std::size_t t = 0; t < room.count(); ++t) room.flip(t);
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(room.mesh());
  expectOneClosedPart(mesh, 8.0);
  EXPECT_TRUE(mesh.parts()[0].inward);
  EXPECT_EQ(mesh.parts()[0].flippedFaces, 12u);
  Silhouette silhouette;
  scene::extractSilhouette(mesh, {0.1, 0.2, 0.3}, silhouette);
  ASSERT_EQ(silhouette.parts.size(), 1u);
  EXPECT_TRUE(silhouette.parts[0].enclosesLight);
  scene::extractSilhouette(mesh, {4, 5, 6}, silhouette);
  EXPECT_EQ(silhouette.loops.size(), 1u);
}

TEST(Repair, DuplicateFacesCountOnce) {
  Triangles triangles = sphere(2);
  for (std::size_t t = 0; t < 100; ++t) {
    const std::uint32_t* c = &triangles.indices[3 * t];
    // The same winding from another corner, and the opposite one.
    triangles.addTriangle(c[1], c[2], c[0]);
    triangles.addTriangle(triangles.indices[3 * t], triangles.indices[3 * t + 2],
                          triangles.indices[3 * t + 1]);
  }
  const scene::TriangleMesh source = triangles.mesh();
  EXPECT_EQ(source.statistics.duplicateTrianglesDropped, 100u);
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(source);
  EXPECT_EQ(mesh.repairs().backToBackFaces, 100u);
  EXPECT_EQ(mesh.faces().size(), 320u);
  expectOneClosedPart(mesh, 4.0 / 3.0 * 3.14159, 0.4);
  expectSound(mesh);
}

TEST(Repair, ATwoSidedLeafIsOneSheet) {
  Triangles leaf = sheet(3);
  const std::size_t count = leaf.count();
  for (std::size_t t = 0; t < count; ++t) {
    leaf.addTriangle(leaf.indices[3 * t], leaf.indices[3 * t + 2], leaf.indices[3 * t + 1]);
  }
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(leaf.mesh());
  ASSERT_EQ(mesh.parts().size(), 1u);
  EXPECT_EQ(mesh.faces().size(), 18u);
  Silhouette silhouette;
  scene::extractSilhouette(mesh, {0.1, 5, 0.2}, silhouette);
  ASSERT_EQ(silhouette.loops.size(), 1u);
  EXPECT_EQ(silhouette.loops[0].count, 12u);
}

TEST(Repair, AFinIsASheetBesideItsClosedShell) {
  Triangles triangles = cube();
  // A square that stands on an upper edge of the cube.
  const auto find = [&](const glm::vec3& p) {
    const auto at = std::find(triangles.positions.begin(), triangles.positions.end(), p);
    return static_cast<std::uint32_t>(at - triangles.positions.begin());
  };
  const std::uint32_t a = find({-1, 1, 1}), b = find({1, 1, 1});
  ASSERT_LT(std::max(a, b), triangles.positions.size());
  const std::uint32_t c = triangles.addVertex({1, 2, 1}), d = triangles.addVertex({-1, 2, 1});
  triangles.addQuad(a, b, c, d);
  const scene::TriangleMesh source = triangles.mesh();
  EXPECT_EQ(source.statistics.nonManifoldEdges, 1u);
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(source);
  ASSERT_EQ(mesh.parts().size(), 2u);
  const bool shellFirst = mesh.parts()[0].closed;
  const CasterPart& shell = mesh.parts()[shellFirst ? 0 : 1];
  const CasterPart& fin = mesh.parts()[shellFirst ? 1 : 0];
  EXPECT_TRUE(shell.closed);
  EXPECT_NEAR(signedVolume(mesh, shell), 8.0, 1e-6);
  EXPECT_FALSE(fin.closed);
  EXPECT_EQ(fin.issue, PartIssue::nonManifold);
  EXPECT_EQ(fin.faceCount, 2u);
  expectSound(mesh);
}

TEST(Repair, AnInnerWallIsASheetInsideItsShell) {
  // Two boxes side by side with one wall between them, which no side of the outer shell needs.
  Triangles triangles;
  const auto v = [&](float x, float y, float z) { return triangles.addVertex({x, y, z}); };
  std::uint32_t p[3][2][2];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 2; ++j) {
      for (int k = 0; k < 2; ++k)
        p[i][j][k] = v(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k));
    }
  }
  for (int i = 0; i < 2; ++i) {
    triangles.addQuad(p[i][0][0], p[i + 1][0][0], p[i + 1][0][1], p[i][0][1]);
    triangles.addQuad(p[i][1][0], p[i][1][1], p[i + 1][1][1], p[i + 1][1][0]);
    triangles.addQuad(p[i][0][0], p[i][1][0], p[i + 1][1][0], p[i + 1][0][0]);
    triangles.addQuad(p[i][0][1], p[i + 1][0][1], p[i + 1][1][1], p[i][1][1]);
  }
  triangles.addQuad(p[0][0][0], p[0][0][1], p[0][1][1], p[0][1][0]);
  triangles.addQuad(p[2][0][0], p[2][1][0], p[2][1][1], p[2][0][1]);
  triangles.addQuad(p[1][0][0], p[1][1][0], p[1][1][1], p[1][0][1]);
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(triangles.mesh());
  ASSERT_EQ(mesh.parts().size(), 2u);
  EXPECT_NE(mesh.parts()[0].closed, mesh.parts()[1].closed);
  const CasterPart& shell = mesh.parts()[mesh.parts()[0].closed ? 0 : 1];
  EXPECT_EQ(shell.faceCount, 20u);
  EXPECT_NEAR(signedVolume(mesh, shell), 2.0, 1e-6);
  expectSound(mesh);
}

TEST(Repair, ClosedShellsThatTouchAlongAnEdgeAreApart) {
  Triangles triangles = cube();
  Triangles second = cube();
  for (std::size_t t = 0; t < second.count(); ++t) second.flip(t);  // wound inward
  triangles.append(second, {2, 2, 0});
  const scene::TriangleMesh source = triangles.mesh();
  EXPECT_GT(source.statistics.nonManifoldEdges, 0u);
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(source);
  ASSERT_EQ(mesh.parts().size(), 2u);
  for (const CasterPart& part : mesh.parts()) {
    EXPECT_TRUE(part.closed);
    EXPECT_NEAR(signedVolume(mesh, part), 8.0, 1e-5);
  }
  expectSound(mesh);
}

TEST(Repair, WhatCannotBeOrientedIsASheetWithAReason) {
  const HalfEdgeMesh mesh = HalfEdgeMesh::build(moebius().mesh());
  ASSERT_EQ(mesh.parts().size(), 1u);
  EXPECT_FALSE(mesh.parts()[0].closed);
  EXPECT_EQ(mesh.parts()[0].issue, PartIssue::notOrientable);
  EXPECT_NE(describe(mesh.parts()[0]).find("wound alike"), std::string::npos);
  expectSound(mesh);
}

TEST(Repair, ZeroAreaTrianglesDoNotOpenACaster) {
  // A vertex in the middle of an edge that a zero-area triangle stitches to the far side.
  Triangles triangles = cubeWithTJunctions(1, 0.0f);
  const auto find = [&](const glm::vec3& p) {
    const auto at = std::find(triangles.positions.begin(), triangles.positions.end(), p);
    return static_cast<std::uint32_t>(at - triangles.positions.begin());
  };
  triangles.addTriangle(find({-1, 1, -1}), find({-1, 1, 0}), find({-1, 1, 1}));
  const scene::TriangleMesh source = triangles.mesh();
  EXPECT_EQ(source.statistics.degenerateTrianglesDropped, 1u);
  expectOneClosedPart(HalfEdgeMesh::build(source), 8.0);
}

TEST(Repair, RandomTriangleHeapsStaySound) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Random random(seed);
    Triangles heap;
    for (int i = 0; i < 12; ++i) heap.addVertex(glm::vec3(random.inBox(1.0)));
    for (int t = 0; t < 30; ++t) {
      const auto pick = [&] { return static_cast<std::uint32_t>(random.between(0, 11.999)); };
      heap.addTriangle(pick(), pick(), pick());
    }
    const HalfEdgeMesh mesh = HalfEdgeMesh::build(heap.mesh());
    expectSound(mesh, seed);
    for (const CasterPart& part : mesh.parts()) {
      EXPECT_TRUE(part.closed || !describe(part).empty());
    }
  }
}

}  // namespace
}  // namespace halfshadow::testing
