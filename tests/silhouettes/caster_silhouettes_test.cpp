// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "scene/light_silhouettes.hpp"
#include "test_meshes.hpp"

namespace halfshadow::testing {
namespace {
using scene::CasterSilhouettes;
using scene::LightPlane;
using scene::LightPoint;
using scene::LightSilhouettes;
using scene::PlacedCaster;

class CasterSilhouettesTest : public ::testing::Test {
 protected:
  CasterSilhouettesTest() {
    for (std::uint32_t i = 0; i < 9; ++i) {
      const glm::dmat4 at = glm::translate(glm::dmat4(1.0), {3.0 * i, 0.2 * i, 0.1});
      casters.push_back({&mesh, glm::rotate(at, 0.4 * i, {0.3, 1.0, 0.2}), i, i + 1});
    }
  }
  /// By the definition, with no help of adjacency: so many welded edges lie between a face that looks at the
  /// point and one that does not.
  std::size_t edgesBetween(const PlacedCaster& caster, const glm::dvec3& pointWorld) const {
    const auto looks = [&](std::uint32_t face) {
      glm::dvec3 corner[3];
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p(mesh.positions()[mesh.faces()[face][k]]);
        corner[k] = glm::dvec3(caster.worldFromObject * glm::dvec4(p, 1.0));
      }
      const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
      return glm::dot(normal, pointWorld - corner[0]) > 0.0;
    };
    std::size_t count = 0;
    for (const scene::EdgeRecord& edge : mesh.edges()) count += looks(edge.face) != looks(edge.opposite);
    return count;
  }
  std::uint64_t extractedBy(auto&& ask) {
    const std::uint64_t before = silhouettes.extracted();
    ask();
    return silhouettes.extracted() - before;
  }
  void askAll(const LightPoint& point) {
    for (const PlacedCaster& caster : casters)
      EXPECT_EQ(silhouettes.of(caster, point).vertices.size(), edgesBetween(caster, point.world));
  }

  scene::HalfEdgeMesh mesh = scene::HalfEdgeMesh::build(sphere(2).mesh());
  std::vector<PlacedCaster> casters;
  CasterSilhouettes silhouettes;
  const LightPoint center{{0, 0}, {11, 31, 4}};
};

TEST_F(CasterSilhouettesTest, EachIsExtractedOnce) {
  EXPECT_EQ(extractedBy([&] { askAll(center); }), 9u);
  EXPECT_EQ(extractedBy([&] { askAll(center); }), 0u);
  casters[4].worldFromObject = glm::translate(casters[4].worldFromObject, {0.4, 1.0, 0.0});
  casters[4].revision = 77;
  EXPECT_EQ(extractedBy([&] { askAll(center); }), 1u);
  EXPECT_EQ(extractedBy([&] { askAll({{0.5, 0.5}, {12, 31, 5}}); }), 9u) << "another point of the light";
  EXPECT_EQ(extractedBy([&] { askAll(center); }), 0u) << "the first is still there";
  EXPECT_EQ(extractedBy([&] { askAll({{0, 0}, {11, 32, 4}}); }), 9u) << "the light moved";
}

TEST_F(CasterSilhouettesTest, ThoseOfCastersThatWentAreDropped) {
  askAll(center);
  const PlacedCaster gone = casters[2];
  casters.erase(casters.begin() + 2);
  silhouettes.keepOnly(casters);
  EXPECT_EQ(extractedBy([&] { askAll(center); }), 0u) << "whatever their numbers and order";
  casters.push_back(gone);
  silhouettes.keepOnly(casters);
  EXPECT_EQ(extractedBy([&] { askAll(center); }), 1u);
}

TEST_F(CasterSilhouettesTest, UnknownRevisionsAreNeverKept) {
  for (PlacedCaster& caster : casters) caster.revision = 0;
  EXPECT_EQ(extractedBy([&] { askAll(center); }), 9u);
  EXPECT_EQ(extractedBy([&] { askAll(center); }), 9u);
}

// Two users, each with its own plane, minimal size and layers, as lists and wedges have.
TEST_F(CasterSilhouettesTest, ServeUsersThatPlaceThemInTheirOwnCoordinates) {
  const auto light = scene::areaLightAimed(center.world, {12, 0, 0}, 2, 1, {0, 0, 1}).value();
  const LightPlane upright(light, 30.0, 1e-4), slanted(light, glm::dvec3(3.0, -28.0, 1.0), 1e-6);
  scene::LightSilhouetteCache lists, wedges;
  const auto both = [&] {
    const LightSilhouettes& one =
        lists.update(silhouettes, casters, upright, 0.0, 0.0, 1e-3, scene::LayerSplit::alongside);
    const LightSilhouettes& other =
        wedges.update(silhouettes, casters, slanted, 0.0, 0.0, 1e-6, scene::LayerSplit::outline);
    LightSilhouettes anew;
    scene::lightSilhouettes(casters, slanted, 0.0, 0.0, 1e-6, anew, scene::LayerSplit::outline);
    EXPECT_EQ(other.points, anew.points);
    ASSERT_EQ(one.points.size(), other.points.size());
    for (std::size_t i = 0; i < one.points.size(); ++i) {
      const glm::dvec3 apart = upright.toWorld(one.points[i]) - slanted.toWorld(other.points[i]);
      EXPECT_LT(glm::length(apart), 1e-12 * 40.0);
    }
  };
  EXPECT_EQ(extractedBy(both), 9u);
  casters[0].revision = 50;
  EXPECT_EQ(extractedBy(both), 1u);
}

}  // namespace
}  // namespace halfshadow::testing
