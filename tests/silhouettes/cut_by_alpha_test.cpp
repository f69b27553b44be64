// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Meshes cut along alpha hold what alpha keeps, point by point, and are whole where it is.
#include "scene/cut_by_alpha.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/caster_geometry.hpp"
#include "scene/cutout.hpp"
#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {

/// [-1, 1]² in xz with texture coordinates 0 to `repeats`, `cells` a side.
scene::TriangleMesh card(int cells, float repeats = 1.0f, const std::vector<glm::vec4>& colors = {}) {
  const Triangles shape = sheet(cells);
  std::vector<glm::vec2> texcoords;
  for (const glm::vec3& p : shape.positions)
    texcoords.push_back(repeats * 0.5f * (glm::vec2(p.x, p.z) + 1.0f));
  auto built = scene::buildMesh({.positions = &shape.positions.front().x,
                                 .vertexCount = static_cast<std::uint32_t>(shape.positions.size()),
                                 .indices = shape.indices.data(),
                                 .indexCount = shape.indices.size(),
                                 .texcoords = &texcoords.front().x,
                                 .colors = colors.empty() ? nullptr : &colors.front().x});
  EXPECT_TRUE(built.ok());
  return std::move(built).value();
}

/// Discs given by middle and radius in texture coordinates, with smooth rims.
std::shared_ptr<const scene::Image> discs(const std::vector<glm::dvec3>& all, int side) {
  scene::Image image{.width = side, .height = side, .channels = 1, .pixels = {}};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      double inside = -1e9;
      for (const glm::dvec3& disc : all)
        inside = std::max(inside,
                          disc.z - glm::length((glm::dvec2(x, y) + 0.5) / double(side) - glm::dvec2(disc)));
      image.pixels.push_back(
          static_cast<std::uint8_t>(std::clamp(127.5 + 127.5 * inside * side, 0.0, 255.0)));
    }
  }
  return std::make_shared<const scene::Image>(std::move(image));
}

double areaOf(const scene::TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
        c(mesh.positions[mesh.indices[i + 2]]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

bool holds(const scene::TriangleMesh& mesh, const glm::dvec2& p) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      const glm::vec3& v = mesh.positions[mesh.indices[i + k]];
      return glm::dvec2(v.x, v.z) - p;
    };
    const glm::dvec2 a = at(0), b = at(1), c = at(2);
    const auto cross = [](const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; };
    const double ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
    if ((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0)) return true;
  }
  return false;
}

TEST(CutByAlpha, ADiscIsADisc) {
  const scene::AlphaCut alpha{.mask = discs({{0.5, 0.5, 0.35}}, 256), .cutoff = 0.5f};
  for (const int cells : {1, 3}) {
    const scene::CutMesh cut = cutByAlpha(card(cells), alpha);
    const double area = areaOf(cut.mesh), expected = std::numbers::pi * 0.7 * 0.7;
    std::printf("%d cells: %u triangles, area %.4f of %.4f\n", cells, cut.mesh.triangleCount(), area,
                expected);
    // At most .03 % a piece, two dozen pieces around.
    EXPECT_NEAR(area, expected, 24 * 3e-4 * expected) << cells;
    EXPECT_FALSE(cut.coarse);
    // One part without a hole or a crack: as many points as edges on its rim, all of them around it once.
    scene::CasterGeometry geometry(alpha);
    EXPECT_EQ(geometry.halfEdges(card(cells)).parts().size(), 1u) << cells;
    double rim = 0.0;
    for (const scene::EdgeRecord& edge : geometry.halfEdges(card(cells)).edges()) {
      if (edge.face != scene::kNoFace && edge.opposite != scene::kNoFace) continue;
      const auto positions = geometry.halfEdges(card(cells)).positions();
      rim += glm::length(positions[edge.from] - positions[edge.to]);
    }
    EXPECT_NEAR(rim, 2.0 * std::numbers::pi * 0.7, 0.05) << cells;
  }
}

TEST(CutByAlpha, HoldsWhatAlphaKeepsPointByPoint) {
  Random random(7);
  for (int round = 0; round < 12; ++round) {
    std::vector<glm::dvec3> all;
    for (int i = 0; i < 5; ++i)
      all.push_back({random.between(0.1, 0.9), random.between(0.1, 0.9), random.between(0.05, 0.25)});
    const float repeats = round % 3 == 0 ? 2.0f : 1.0f;
    const scene::AlphaCut alpha{.mask = discs(all, 128), .cutoff = round % 2 == 0 ? 0.5f : 0.3f};
    const scene::TriangleMesh whole = card(1 + round % 4, repeats);
    const scene::CutMesh cut = cutByAlpha(whole, alpha);
    int wrong = 0, kept = 0;
    constexpr int kPoints = 2000;
    for (int i = 0; i < kPoints; ++i) {
      const glm::dvec2 p(random.between(-1, 1), random.between(-1, 1));
      const bool there =
          scene::alphaAt(*alpha.mask, alpha.sampling, repeats * 0.5 * (p + 1.0)) >= alpha.cutoff;
      kept += there;
      wrong += holds(cut.mesh, p) != there;
    }
    // .03 % of each triangle's area a piece, a few dozen pieces along the outline of each.
    EXPECT_LE(wrong, 0.01 * kPoints) << "round " << round;
    EXPECT_GT(kept, kPoints / 20);
  }
}

TEST(CutByAlpha, NeighboursHaveTheSamePointsOnTheirEdge) {
  const scene::AlphaCut alpha{.mask = discs({{0.3, 0.4, 0.2}, {0.62, 0.55, 0.24}}, 128), .cutoff = 0.5f};
  const scene::TriangleMesh mesh = cutByAlpha(card(2), alpha).mesh;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::uint32_t from = mesh.weldedVertex[mesh.indices[i]],
                        to = mesh.weldedVertex[mesh.indices[i - i % 3 + (i + 1) % 3]];
    const glm::dvec3 a(mesh.positions[from]), b(mesh.positions[to]);
    for (const std::uint32_t index : mesh.indices) {
      const std::uint32_t other = mesh.weldedVertex[index];
      if (other == from || other == to) continue;
      const glm::dvec3 p(mesh.positions[other]);
      const double along = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
      if (along < 1e-3 || along > 1.0 - 1e-3) continue;
      ASSERT_GT(glm::length(p - glm::mix(a, b, along)), 1e-6) << from << " " << to << " " << other;
    }
  }
}

TEST(CutByAlpha, StopsWhereItIsToldTo) {
  std::vector<glm::dvec3> all;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) all.push_back({(x + 0.5) / 8.0, (y + 0.5) / 8.0, 0.04});
  }
  const scene::AlphaCut alpha{.mask = discs(all, 256), .cutoff = 0.5f};
  const scene::CutMesh few = cutByAlpha(card(1), alpha, 100), many = cutByAlpha(card(1), alpha);
  EXPECT_TRUE(few.coarse);
  EXPECT_FALSE(many.coarse);
  // Those that are cut last may leave two each.
  EXPECT_LE(few.mesh.triangleCount(), 2u * (2 + 101));
  EXPECT_GT(many.mesh.triangleCount(), few.mesh.triangleCount());
}

TEST(CutByAlpha, WhatIsAllThereStaysAndWhatIsNotGoes) {
  const scene::TriangleMesh whole = card(3);
  EXPECT_EQ(cutByAlpha(whole, {.mask = discs({{0.5, 0.5, 5.0}}, 16), .cutoff = 0.5f}).mesh.indices,
            whole.indices);
  EXPECT_EQ(cutByAlpha(whole, {.mask = discs({}, 16), .cutoff = 0.5f}).mesh.triangleCount(), 0u);
  scene::CasterGeometry nothing({.mask = discs({}, 16), .cutoff = 0.5f});
  EXPECT_TRUE(nothing.halfEdges(whole).parts().empty());
}

TEST(CutByAlpha, ColoursOfVerticesCutToo) {
  std::vector<glm::vec4> colors;
  for (const glm::vec3& p : sheet(2).positions) colors.push_back(glm::vec4(1, 1, 1, 0.5f * (p.x + 1.0f)));
  const scene::CutMesh cut = cutByAlpha(card(2, 1.0f, colors), {.mask = nullptr, .cutoff = 0.75f});
  EXPECT_NEAR(areaOf(cut.mesh), 1.0, 1e-2);
}

TEST(CutByAlpha, FollowsItsMesh) {
  const scene::AlphaCut alpha{.mask = discs({{0.4, 0.5, 0.3}}, 64), .cutoff = 0.5f};
  scene::TriangleMesh mesh = card(2);
  scene::CasterGeometry geometry(alpha);
  const std::vector<glm::vec3> before(geometry.halfEdges(mesh).positions().begin(),
                                      geometry.halfEdges(mesh).positions().end());
  const auto moved = [](const glm::vec3& p) {
    return glm::vec3(2.0f * p.x + p.z, 0.5f * p.x - 1.0f, p.z + 3.0f);
  };
  for (glm::vec3& p : mesh.positions) p = moved(p);
  geometry.positionsChanged();
  const auto after = geometry.halfEdges(mesh).positions();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_LT(glm::length(after[i] - moved(before[i])), 1e-5f) << i;
}

}  // namespace
}  // namespace halfshadow::testing
