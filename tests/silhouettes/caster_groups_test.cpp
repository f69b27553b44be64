// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// One thing in several pieces casts as one thing; what is whole is left alone.
#include "scene/caster_groups.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <glm/gtc/matrix_transform.hpp>

#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {
using scene::CasterGroups;
using scene::SceneCaster;

/// Owns what SceneCaster points to.
class Pieces {
 public:
  void add(const Triangles& triangles, const glm::dmat4& worldFromObject) {
    meshes_.push_back(triangles.mesh());
    geometries_.emplace_back();
    casters.push_back({&meshes_.back(), &geometries_.back(), worldFromObject, ++revision_});
  }
  void move(std::size_t i, const glm::dmat4& worldFromObject) {
    casters[i].worldFromObject = worldFromObject;
    casters[i].revision = ++revision_;
  }
  std::vector<SceneCaster> casters;

 private:
  std::deque<scene::TriangleMesh> meshes_;
  std::deque<scene::CasterGeometry> geometries_;
  std::uint64_t revision_ = 0;
};

/// Triangles with their middle on one side of a plane, the others, and vertices of their own for each.
std::vector<Triangles> cutInTwo(const Triangles& whole, const glm::vec3& normal) {
  std::vector<Triangles> halves(2);
  for (std::size_t t = 0; t < whole.count(); ++t) {
    glm::vec3 middle(0.0f);
    for (std::size_t k = 0; k < 3; ++k) middle += whole.positions[whole.indices[3 * t + k]];
    Triangles& half = halves[glm::dot(middle, normal) > 0.05f];
    const auto corner = [&](std::size_t k) {
      return half.addVertex(whole.positions[whole.indices[3 * t + k]]);
    };
    half.addTriangle(corner(0), corner(1), corner(2));
  }
  return halves;
}

/// The same triangles, with their vertices brought into the coordinates of an object.
Triangles inObject(const Triangles& world, const glm::dmat4& worldFromObject) {
  Triangles result = world;
  const glm::dmat4 objectFromWorld = glm::inverse(worldFromObject);
  for (glm::vec3& p : result.positions) p = glm::vec3(objectFromWorld * glm::dvec4(p, 1.0));
  return result;
}

double volumeOf(const scene::PlacedCaster& caster) {
  double sum = 0.0;
  for (const glm::uvec3& f : caster.mesh->faces()) {
    const auto at = [&](int k) { return glm::dvec3(caster.mesh->positions()[f[k]]); };
    sum += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
  }
  return sum * std::abs(glm::determinant(glm::dmat3(caster.worldFromObject)));
}

TEST(CasterGroups, HalvesOfAClosedShapeAreTheShape) {
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  const glm::dmat4 places[] = {glm::dmat4(1.0), glm::translate(glm::dmat4(1.0), {1e5, -2e4, 3e3}) * turned,
                               glm::scale(turned, {3.0, 0.5, 1.0}),
                               glm::scale(glm::dmat4(1.0), glm::dvec3(1e-6)),
                               glm::scale(turned, {-1.0, 1.0, 1.0})};
  for (const Triangles& whole : {cube(), sphere(2), torus(1.0, 0.3), capsule()}) {
    for (const glm::dmat4& place : places) {
      Pieces alone, split;
      alone.add(whole, place);
      for (const Triangles& half : cutInTwo(whole, {0.3f, 1.0f, 0.2f})) split.add(half, place);
      CasterGroups one, two;
      one.update(alone.casters);
      two.update(split.casters);
      ASSERT_EQ(two.placed().size(), 1u);
      EXPECT_EQ(two.placedOf(0), 0u);
      EXPECT_EQ(two.placedOf(1), 0u);
      const scene::PlacedCaster& welded = two.placed()[0];
      ASSERT_EQ(welded.mesh->parts().size(), 1u);
      EXPECT_TRUE(welded.mesh->parts()[0].closed);
      EXPECT_EQ(welded.mesh->faces().size(), whole.count());
      EXPECT_NEAR(volumeOf(welded) / volumeOf(one.placed()[0]), 1.0, 1e-4);
    }
  }
}

TEST(CasterGroups, PiecesMayHaveFramesOfTheirOwn) {
  // The halves' coordinates are rounded in different places, one of them mirrored.
  const glm::dmat4 left = glm::rotate(glm::translate(glm::dmat4(1.0), {40.0, 3.0, -7.0}), 1.1, {0, 1, 0});
  const glm::dmat4 right = glm::scale(glm::translate(glm::dmat4(1.0), {-20.0, 1.0, 0.5}), {-2.0, 2.0, 2.0});
  Triangles whole = sphere(3);
  for (glm::vec3& p : whole.positions) p += glm::vec3(5.0f, 0.0f, 2.0f);
  Pieces split;
  auto halves = cutInTwo(whole, {0.0f, 1.0f, 0.0f});
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::dmat4& place = i == 0 ? left : right;
    Triangles half = inObject(halves[i], place);
    // Mirrored transforms come with windings that they turn outward.
    for (std::size_t t = 0; i == 1 && t < half.count(); ++t) half.flip(t);
    split.add(half, place);
  }
  CasterGroups groups;
  groups.update(split.casters);
  ASSERT_EQ(groups.placed().size(), 1u);
  ASSERT_EQ(groups.placed()[0].mesh->parts().size(), 1u);
  const scene::CasterPart& part = groups.placed()[0].mesh->parts()[0];
  EXPECT_TRUE(part.closed);
  EXPECT_EQ(part.flippedFaces, 0u);
  EXPECT_FALSE(part.inward);
}

TEST(CasterGroups, WhatOnlyComesNearStaysAlone) {
  Pieces pieces;
  pieces.add(cube(), glm::dmat4(1.0));
  pieces.add(cube(), glm::translate(glm::dmat4(1.0), {2.0, 0.0, 0.0}));  // closed, face to face
  pieces.add(sheet(2), glm::translate(glm::dmat4(1.0), {9.0, 0.0, 0.0}));
  pieces.add(sheet(2), glm::translate(glm::dmat4(1.0), {11.001, 0.0, 0.0}));  // a visible gap
  pieces.add(sheet(2), glm::translate(glm::dmat4(1.0), {13.001, 0.0, 2.0}));  // one corner
  CasterGroups groups;
  groups.update(pieces.casters);
  ASSERT_EQ(groups.placed().size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(groups.placedOf(i), i);
    EXPECT_EQ(groups.placed()[i].mesh, &pieces.casters[i].geometry->halfEdges(*pieces.casters[i].mesh));
    EXPECT_EQ(groups.placed()[i].revision, pieces.casters[i].revision);
  }
  EXPECT_EQ(groups.weldedCount(), 0u);
}

TEST(CasterGroups, WallsOfOtherSubdivisionMeetAtTheirCorners) {
  Pieces pieces;
  pieces.add(sheet(3), glm::dmat4(1.0));
  pieces.add(sheet(5),
             glm::rotate(glm::translate(glm::dmat4(1.0), {1.0, 1.0, 0.0}), std::acos(0.0), {0, 0, 1}));
  CasterGroups groups;
  groups.update(pieces.casters);
  ASSERT_EQ(groups.placed().size(), 1u);
  EXPECT_EQ(groups.placed()[0].mesh->parts().size(), 1u);
}

TEST(CasterGroups, KeepsGroupsThatStay) {
  Pieces pieces;
  for (int k = 0; k < 3; ++k) {
    for (const Triangles& half : cutInTwo(sphere(1), {0.0f, 1.0f, 0.0f}))
      pieces.add(half, glm::translate(glm::dmat4(1.0), {4.0 * k, 0.0, 0.0}));
  }
  pieces.add(cube(), glm::translate(glm::dmat4(1.0), {0.0, 9.0, 0.0}));
  CasterGroups groups;
  groups.update(pieces.casters);
  EXPECT_EQ(groups.weldedCount(), 3u);
  ASSERT_EQ(groups.placed().size(), 4u);
  const scene::HalfEdgeMesh* kept = groups.placed()[0].mesh;
  groups.update(pieces.casters);
  EXPECT_EQ(groups.weldedCount(), 0u);
  pieces.move(6, glm::dmat4(1.0));
  groups.update(pieces.casters);
  EXPECT_EQ(groups.weldedCount(), 0u) << "only the cube moved";
  EXPECT_EQ(groups.placed()[0].mesh, kept);
  // Moved together it is one again, moved apart it is two.
  const glm::dmat4 away = glm::translate(glm::dmat4(1.0), {4.0, 2.0, 0.0});
  pieces.move(2, away);
  groups.update(pieces.casters);
  EXPECT_EQ(groups.placed().size(), 5u);
  pieces.move(3, away);
  groups.update(pieces.casters);
  EXPECT_EQ(groups.weldedCount(), 1u);
  EXPECT_EQ(groups.placed().size(), 4u);
}

}  // namespace
}  // namespace halfshadow::testing
