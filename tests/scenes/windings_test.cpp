// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Windings are mended in the mesh itself: whatever winding a closed shell comes in, it ends up outward.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "scene/mesh.hpp"

namespace halfshadow::scene {
namespace {

struct Soup {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;

  void add(const Soup& other, const glm::vec3& offset, float scale) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const glm::vec3& p : other.positions) positions.push_back(p * scale + offset);
    for (const std::uint32_t i : other.indices) indices.push_back(first + i);
  }
  void flip(std::size_t triangle) { std::swap(indices[3 * triangle + 1], indices[3 * triangle + 2]); }
  std::size_t count() const { return indices.size() / 3; }
  Result<TriangleMesh> build() const {
    return buildMesh({.positions = &positions.front().x,
                      .vertexCount = static_cast<std::uint32_t>(positions.size()),
                      .indices = indices.data(),
                      .indexCount = indices.size()});
  }
};

/// Side 2 around the origin, outward.
Soup cube() {
  Soup soup;
  for (unsigned i = 0; i < 8; ++i) {
    soup.positions.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  }
  soup.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return soup;
}

Soup torus(int around, int across) {
  Soup soup;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 6.283185307179586 * i / around, b = 6.283185307179586 * j / across;
      const double r = 2.0 + 0.5 * std::cos(b);
      soup.positions.emplace_back(r * std::cos(a), 0.5 * std::sin(b), r * std::sin(a));
      const auto at = [&](int u, int v) {
        return static_cast<std::uint32_t>(u % around * across + v % across);
      };
      const std::uint32_t p = at(i, j), q = at(i + 1, j), s = at(i, j + 1), t = at(i + 1, j + 1);
      soup.indices.insert(soup.indices.end(), {p, s, q, q, s, t});
    }
  }
  return soup;
}

double volumeOf(const TriangleMesh& mesh, std::uint32_t shell) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (mesh.shellOf[t] != shell) continue;
    const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[3 * t + k]]); };
    sum += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
  }
  return sum;
}

/// The source's winding, from the mended mesh and what it says was turned.
std::vector<std::uint32_t> unmended(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> indices = mesh.indices;
  for (std::size_t t = 0; t < mesh.turned.size(); ++t) {
    if (mesh.turned[t]) std::swap(indices[3 * t + 1], indices[3 * t + 2]);
  }
  return indices;
}

TEST(Windings, ClosedShellsEndUpOutwardFromAnyWinding) {
  std::mt19937 random(11);
  for (const Soup& shape : {cube(), torus(9, 5)}) {
    for (int round = 0; round < 40; ++round) {
      // A share of the triangles flipped: none, some, all.
      Soup soup = shape;
      const double share = round % 5 / 4.0;
      for (std::size_t t = 0; t < soup.count(); ++t) {
        if (std::uniform_real_distribution<double>(0, 1)(random) < share) soup.flip(t);
      }
      const auto mesh = soup.build();
      ASSERT_TRUE(mesh.ok());
      ASSERT_EQ(mesh->shellCount, 1u);
      EXPECT_GT(volumeOf(*mesh, 0), 1.0);
      EXPECT_TRUE(mesh->statistics.closed());
      EXPECT_EQ(unmended(*mesh), soup.indices) << "what was turned is known";
      std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
      for (std::size_t i = 0; i < mesh->indices.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        ++directed[{mesh->indices[i], mesh->indices[next]}];
      }
      for (const auto& [edge, uses] : directed) ASSERT_EQ(uses, 1) << "neighbours disagree";
    }
  }
}

TEST(Windings, EveryShellIsJudgedByItself) {
  // A cavity wound inward, a neighbour wound inward, and two cubes that touch along an edge.
  Soup soup;
  soup.add(cube(), {0, 0, 0}, 3.0f);
  soup.add(cube(), {0, 0, 0}, 1.0f);
  soup.add(cube(), {9, 0, 0}, 1.0f);
  soup.add(cube(), {11, 2, 0}, 1.0f);
  for (std::size_t t = 12; t < 36; ++t) soup.flip(t);
  const auto mesh = soup.build();
  ASSERT_TRUE(mesh.ok());
  ASSERT_EQ(mesh->shellCount, 4u);
  EXPECT_EQ(mesh->statistics.nonManifoldEdges, 1u);
  for (std::uint32_t shell = 0; shell < 4; ++shell) EXPECT_GT(volumeOf(*mesh, shell), 7.9) << shell;
}

TEST(Windings, WhatIsOpenOrHasNoOutsideStaysAsItIs) {
  Soup open = cube();
  open.indices.resize(30);
  open.flip(3);
  Soup leaf;  // a triangle and its back
  leaf.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  leaf.indices = {0, 1, 2, 0, 2, 1};
  Soup moebius;
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i) {
    const double a = 6.283185307179586 * i / kSteps;
    for (const double side : {-0.4, 0.4}) {
      const double r = 2.0 + side * std::cos(a / 2);
      moebius.positions.emplace_back(r * std::cos(a), side * std::sin(a / 2), r * std::sin(a));
    }
    const auto at = [&](int step, int side) {
      const bool round = step == kSteps;
      return static_cast<std::uint32_t>(2 * (round ? 0 : step) + (round ? 1 - side : side));
    };
    moebius.indices.insert(moebius.indices.end(),
                           {at(i, 0), at(i, 1), at(i + 1, 0), at(i, 1), at(i + 1, 1), at(i + 1, 0)});
  }
  for (const Soup& soup : {open, leaf, moebius}) {
    const auto mesh = soup.build();
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(mesh->indices, soup.indices);
    EXPECT_TRUE(mesh->turned.empty());
  }
}

TEST(Windings, AMirroringPoseIsTurnedBack) {
  auto built = torus(9, 5).build();
  ASSERT_TRUE(built.ok());
  TriangleMesh mesh = *built;
  const std::vector<std::uint32_t> outward = mesh.indices;
  EXPECT_FALSE(turnShellsOutward(mesh));
  for (glm::vec3& p : mesh.positions) p.x = -p.x;
  EXPECT_TRUE(turnShellsOutward(mesh));
  EXPECT_GT(volumeOf(mesh, 0), 1.0);
  for (glm::vec3& p : mesh.positions) p.x = -p.x;
  EXPECT_TRUE(turnShellsOutward(mesh));
  EXPECT_EQ(mesh.indices, outward);
}

TEST(Recenter, KeepsEveryVertexExactly) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  int moved = 0;
  for (int round = 0; round < 200; ++round) {
    const glm::vec3 offset =
        glm::vec3(unit(random), unit(random), unit(random)) * std::exp2(static_cast<float>(round % 20));
    Soup soup;
    soup.add(cube(), offset, 0.3f + 0.2f * unit(random));
    auto mesh = soup.build();
    ASSERT_TRUE(mesh.ok());
    const std::vector<glm::vec3> before = mesh->positions;
    const glm::dvec3 center = recenter(*mesh);
    moved += center != glm::dvec3(0.0);
    for (std::size_t i = 0; i < before.size(); ++i) {
      ASSERT_EQ(glm::dvec3(mesh->positions[i]) + center, glm::dvec3(before[i])) << round;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(offset[axis]) < 4.0f) continue;
      for (const glm::vec3& p : mesh->positions) ASSERT_LT(std::abs(p[axis]), 2.0f) << round;
    }
  }
  EXPECT_GT(moved, 100);
}

}  // namespace
}  // namespace halfshadow::scene
