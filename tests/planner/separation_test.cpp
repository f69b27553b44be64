// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Casters that can shadow nothing are left out of a light's view, and no others.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <optional>
#include <random>

#include "planner/frame_planner.hpp"

namespace halfshadow::planner {
namespace {

struct Shape {
  scene::TriangleMesh mesh;
  glm::dvec3 recenteredBy{0.0};
};

Shape shapeOf(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices) {
  auto mesh = scene::buildMesh({.positions = &positions.front().x,
                                .vertexCount = static_cast<std::uint32_t>(positions.size()),
                                .indices = indices.data(),
                                .indexCount = indices.size()});
  EXPECT_TRUE(mesh.ok());
  Shape shape{std::move(mesh).value()};
  shape.recenteredBy = scene::recenter(shape.mesh);
  return shape;
}

Shape box(const glm::vec3& low, const glm::vec3& high) {
  std::vector<glm::vec3> positions;
  for (unsigned i = 0; i < 8; ++i) {
    positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  }
  return shapeOf(positions, {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                             2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5});
}

/// A grid in the plane y = 0; `dent` lowers its middle vertices.
Shape grid(int cells, float half, float dent = 0.0f) {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  for (int z = 0; z <= cells; ++z) {
    for (int x = 0; x <= cells; ++x) {
      const bool inner = x > 0 && z > 0 && x < cells && z < cells;
      positions.push_back(
          {(2.0f * x / cells - 1) * half, inner ? -dent : 0.0f, (2.0f * z / cells - 1) * half});
      if (x == cells || z == cells) continue;
      const auto at = static_cast<std::uint32_t>(z * (cells + 1) + x),
                 below = at + static_cast<std::uint32_t>(cells) + 1;
      indices.insert(indices.end(), {at, below, at + 1, at + 1, below, below + 1});
    }
  }
  return shapeOf(positions, indices);
}

/// A tetrahedron: no plane of its box is a plane of its own.
Shape tetrahedron() {
  return shapeOf({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2});
}

class World {
 public:
  std::uint32_t add(Shape shape, const glm::dmat4& worldFromObject = glm::dmat4(1.0), bool casts = true,
                    bool receives = true) {
    shapes_.push_back(std::make_unique<Shape>(std::move(shape)));
    const Shape& kept = *shapes_.back();
    supports_.push_back(
        std::make_unique<scene::SupportingPlanes>(scene::supportingPlanesOf(kept.mesh, kept.recenteredBy)));
    const glm::dmat4 placed = glm::translate(worldFromObject, kept.recenteredBy);
    const auto id = static_cast<std::uint32_t>(objects_.size()) + 1;
    objects_.push_back({.id = id,
                        .boundsWorld = scene::transformed(placed, scene::boundsOf(kept.mesh)),
                        .revision = id,
                        .casts = casts,
                        .receives = receives,
                        .mesh = &kept.mesh,
                        .support = supports_.back().get(),
                        .worldFromObject = placed});
    return id - 1;
  }
  FramePlan plan(const scene::AreaLight& light, const scene::Camera& camera) const {
    const std::uint64_t revision = 1;
    FramePlanner planner;
    return planner.plan({.objects = objects_,
                         .camera = &camera,
                         .aspectWidthOverHeight = 1.3,
                         .lights = {&light, 1},
                         .lightRevisions = {&revision, 1}});
  }
  bool casts(const FramePlan& plan, std::uint32_t object) const {
    const auto& casters = plan.lights[0].casters;
    return std::find(casters.begin(), casters.end(), object) != casters.end();
  }
  std::array<glm::dvec3, 3> triangle(std::uint32_t object, std::size_t t) const {
    const PlannedObject& o = objects_[object];
    std::array<glm::dvec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = glm::dvec3(o.worldFromObject *
                              glm::dvec4(glm::dvec3(o.mesh->positions[o.mesh->indices[3 * t + k]]), 1.0));
    }
    return corners;
  }
  std::size_t triangleCount(std::uint32_t object) const { return objects_[object].mesh->triangleCount(); }
  const std::vector<PlannedObject>& objects() const { return objects_; }

 private:
  std::vector<std::unique_ptr<Shape>> shapes_;
  std::vector<std::unique_ptr<scene::SupportingPlanes>> supports_;
  std::vector<PlannedObject> objects_;
};

std::optional<SkipReason> reasonFor(const FramePlan& plan, std::uint32_t object) {
  for (const Skip& skip : plan.skips) {
    if (skipName(skip) == "caster " + std::to_string(object + 1)) return skip.reason;
  }
  return std::nullopt;
}

scene::AreaLight lightAt(const glm::dvec3& center, double size = 1.0) {
  return *scene::areaLightAimed(center, {0, 0, 0}, size, size, {0.2, 0.1, 1.0});
}
const scene::Camera kCamera{.eyeWorld = {-6, 7, 5}, .targetWorld = {0, 0, 0}};

TEST(Separation, AGroundUnderWhatStandsOnItIsNoCaster) {
  for (const bool asSlab : {false, true}) {
    for (const double angle : {0.0, 0.4, 1.1}) {
      // Anywhere, at any tilt: what decides is the plane that the ground and the boxes share.
      for (const glm::dvec3& place : {glm::dvec3(0.0), glm::dvec3(1234.5, -77.25, 31.0)}) {
        const glm::dmat4 world = glm::rotate(glm::translate(glm::dmat4(1.0), place), angle,
                                             glm::normalize(glm::dvec3(1, 0.3, 0.2)));
        World scene;
        const auto ground = scene.add(asSlab ? box({-60, -1, -60}, {60, 0, 60}) : grid(12, 60), world);
        const auto standing = scene.add(box({-1, 0, -1}, {1, 2, 1}), world);
        const auto turned =
            scene.add(box({-1, 0, -1}, {1, 2, 1}),
                      glm::rotate(glm::translate(world, glm::dvec3(5, 0, 0)), 0.7, glm::dvec3(0, 1, 0)));
        scene::AreaLight light = lightAt({3, 12, 2}, 2.0);
        const glm::dmat3 turn(world);
        light.centerWorld = glm::dvec3(world * glm::dvec4(light.centerWorld, 1.0));
        light.halfU = turn * light.halfU, light.halfV = turn * light.halfV,
        light.emission = turn * light.emission;
        scene::Camera camera = kCamera;
        camera.eyeWorld = glm::dvec3(world * glm::dvec4(kCamera.eyeWorld, 1.0));
        camera.targetWorld = place;
        const FramePlan plan = scene.plan(light, camera);
        EXPECT_FALSE(scene.casts(plan, ground)) << asSlab << " " << angle;
        EXPECT_EQ(reasonFor(plan, ground), SkipReason::nothingBeyond);
        EXPECT_TRUE(scene.casts(plan, standing));
        EXPECT_TRUE(scene.casts(plan, turned));
        EXPECT_EQ(plan.receivers.size(), 3u) << "it still receives";
      }
    }
  }
}

TEST(Separation, WhatIsSunkIntoAGroundCountsOnlyWhereItIsSeen) {
  for (const bool asSlab : {false, true}) {
    World sunk;
    const auto ground = sunk.add(asSlab ? box({-9, -1, -9}, {9, 0, 9}) : grid(4, 9));
    sunk.add(box({-1, -2, -1}, {1, 2, 1}), glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(0.6, 0.8, 0)));
    const scene::AreaLight light = lightAt({3, 12, 2});
    EXPECT_FALSE(sunk.casts(sunk.plan(light, kCamera), ground));
    // From below, and past the edge, its foot is seen.
    const scene::Camera below{.eyeWorld = {-6, -7, 5}, .targetWorld = {0, 0, 0}};
    EXPECT_TRUE(sunk.casts(sunk.plan(light, below), ground));
    World atTheEdge;
    const auto plate = atTheEdge.add(asSlab ? box({-9, -1, -9}, {9, 0, 9}) : grid(4, 9));
    atTheEdge.add(box({-9.5f, -2, -1}, {-8, 2, 1}));
    EXPECT_TRUE(atTheEdge.casts(atTheEdge.plan(light, kCamera), plate));
  }
}

TEST(Separation, TheCameraDecidesAnewWhenItMovesBelowAGround) {
  World sunk;
  const auto ground = sunk.add(grid(4, 9));
  sunk.add(box({-1, -2, -1}, {1, 2, 1}));
  const scene::AreaLight light = lightAt({3, 12, 2});
  const std::uint64_t revision = 1;
  FramePlanner planner;
  const auto keyAt = [&](const glm::dvec3& eye, bool casts) {
    const scene::Camera camera{.eyeWorld = eye, .targetWorld = {0, 0, 0}};
    const FramePlan plan = planner.plan({.objects = sunk.objects(),
                                         .camera = &camera,
                                         .aspectWidthOverHeight = 1.3,
                                         .lights = {&light, 1},
                                         .lightRevisions = {&revision, 1}});
    EXPECT_EQ(sunk.casts(plan, ground), casts);
    return plan.lights[0].contentKey;
  };
  const std::uint64_t above = keyAt({-6, 7, 5}, false);
  EXPECT_EQ(keyAt({6, 3, 5}, false), above) << "moved about above, nothing is remade";
  EXPECT_NE(keyAt({6, -3, 5}, true), above);
  EXPECT_EQ(keyAt({-6, 7, 5}, false), above);
}

TEST(Separation, AGroundThatMayShadowItselfStays) {
  World dented;
  const auto hollow = dented.add(grid(4, 60, 0.5f));
  EXPECT_TRUE(dented.casts(dented.plan(lightAt({30, 4, 2}), kCamera), hollow)) << "it may shadow itself";
}

TEST(Separation, CastersBelowTheFloorAreLeftOut) {
  World scene;
  const auto floor = scene.add(grid(1, 60), glm::dmat4(1.0), false);
  const auto above = scene.add(box({-1, 0, -1}, {1, 2, 1}));
  const auto below = scene.add(
      tetrahedron(),
      glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(3, -2.5, 0)), 0.8, glm::dvec3(0.6, 0.0, 0.8)),
      true, false);
  const FramePlan plan = scene.plan(lightAt({3, 12, 2}, 2.0), kCamera);
  EXPECT_FALSE(scene.casts(plan, below));
  EXPECT_EQ(reasonFor(plan, below), SkipReason::nothingBeyond);
  EXPECT_TRUE(scene.casts(plan, above));
  EXPECT_NE(reasonFor(plan, floor), SkipReason::nothingBeyond) << "it casts nothing anyway";
}

TEST(Separation, AConvexRoomAroundLightAndReceiversIsNoCaster) {
  World room;
  const auto walls = room.add(box({-3, 0, -3}, {3, 3, 3}));
  const auto table = room.add(box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}));
  const scene::AreaLight lamp = lightAt({1, 2.5, 1}, 0.4);
  const scene::Camera inside{.eyeWorld = {-2, 1.6, 2}, .targetWorld = {0, 1, 0}};
  const FramePlan within = room.plan(lamp, inside);
  EXPECT_FALSE(room.casts(within, walls));
  EXPECT_TRUE(room.casts(within, table));
  // A light outside leaves it dark, wherever the camera is; seen from within, its own walls are receivers.
  EXPECT_TRUE(room.casts(room.plan(lightAt({3, 9, 4}), inside), walls));
  World empty;
  const auto house = empty.add(box({-3, 0, -3}, {3, 3, 3}));
  EXPECT_TRUE(empty.casts(empty.plan(lightAt({9, 12, 8}), inside), house));
  EXPECT_FALSE(empty.casts(empty.plan(lightAt({9, 12, 8}), kCamera), house))
      << "outside, all of it that faces is lit";
  // A ground outside is shadowed by it, which shows from outside only.
  room.add(grid(1, 40), glm::translate(glm::dmat4(1.0), glm::dvec3(0, -1, 0)), false);
  EXPECT_FALSE(room.casts(room.plan(lamp, inside), walls));
  const scene::Camera outside{.eyeWorld = {-9, 4, 8}, .targetWorld = {0, 0, 0}};
  EXPECT_TRUE(room.casts(room.plan(lamp, outside), walls));
  // Not where the near plane opens a wall.
  const scene::Camera opening{.eyeWorld = {-2, 1.6, 2}, .targetWorld = {0, 1, 0}, .nearDistance = 6.0};
  EXPECT_TRUE(room.casts(room.plan(lamp, opening), walls));
}

TEST(Separation, ALightThatCutsAFacesPlaneKeepsTheBody) {
  World scene;
  const auto body = scene.add(box({-1, 0, -1}, {1, 2, 1}));
  EXPECT_TRUE(scene.casts(scene.plan(lightAt({1.2, 8, 0}, 1.0), kCamera), body));
}

/// The share of the way at which the ray meets the triangle, at least `inside` (barycentric) from its edges;
/// 2 when it does not.
double meets(const std::array<glm::dvec3, 3>& t, const glm::dvec3& from, const glm::dvec3& to,
             double inside) {
  const glm::dvec3 way = to - from, ab = t[1] - t[0], ac = t[2] - t[0], p = glm::cross(way, ac);
  const double determinant = glm::dot(ab, p);
  if (std::abs(determinant) < 1e-12) return 2.0;
  const glm::dvec3 toFrom = from - t[0];
  const double u = glm::dot(toFrom, p) / determinant;
  const glm::dvec3 q = glm::cross(toFrom, ab);
  const double v = glm::dot(way, q) / determinant;
  if (u < inside || v < inside || u + v > 1.0 - inside) return 2.0;
  return glm::dot(ac, q) / determinant;
}

TEST(Separation, NeverLeavesOutACasterThatASampledRayHits) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(-1, 1), positive(0, 1);
  const auto vector = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  const auto placement = [&](double spread) {
    // Many rest on each other: planes that touch are where a proof is easily one too many.
    glm::dmat4 m = glm::translate(
        glm::dmat4(1.0), positive(random) < 0.5 ? glm::dvec3(unit(random) * spread, 0, unit(random) * spread)
                                                : vector() * spread);
    if (positive(random) < 0.6) m = glm::rotate(m, unit(random) * 3.0, glm::normalize(vector()));
    return glm::scale(m, glm::dvec3(0.3 + positive(random)));
  };
  const auto shape = [&]() -> Shape {
    switch (random() % 4) {
      case 0:
        return grid(1 + static_cast<int>(random() % 3), 1.0f + 4.0f * static_cast<float>(positive(random)));
      case 1:
        return tetrahedron();
      case 2:
        return grid(3, 2.0f, 0.4f);
      default:
        return box({-1, 0, -1}, {1, 2, 1});
    }
  };
  int hits = 0, leftOut = 0, hitsOfKept = 0;
  for (int round = 0; round < 6000; ++round) {
    World scene;
    for (int i = 0; i < 3; ++i) scene.add(shape(), placement(2.5));
    const scene::AreaLight light =
        lightAt(vector() * 4.0 + glm::dvec3(0, 4.0 * positive(random), 0), 2.0 * positive(random));
    const scene::Camera camera{.eyeWorld = round % 3 == 0 ? vector() * 1.5 : vector() * 9.0,
                               .targetWorld = {0, 0.01, 0}};
    const FramePlan plan = scene.plan(light, camera);
    for (std::uint32_t caster = 0; caster < 3; ++caster) {
      const bool kept = scene.casts(plan, caster);
      leftOut += !kept;
      for (int sample = 0; sample < 60; ++sample) {
        const auto receiver = static_cast<std::uint32_t>(random() % 3);
        const auto t = scene.triangle(receiver, random() % scene.triangleCount(receiver));
        double a = positive(random), b = positive(random);
        if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
        const glm::dvec3 from = t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
        const glm::dvec3 to = light.centerWorld + light.halfU * unit(random) + light.halfV * unit(random);
        if (glm::dot(from - light.centerWorld, light.emission) <= 0.0) continue;  // behind the light: 1
        // A receiver faces the light on the side that the camera sees.
        const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
        if (glm::dot(normal, camera.eyeWorld - from) * glm::dot(normal, light.centerWorld - from) <= 0.0)
          continue;
        for (std::size_t k = 0; k < scene.triangleCount(caster); ++k) {
          const double share = meets(scene.triangle(caster, k), from, to, 1e-4);
          if (share <= 1e-6 || share >= 1.0) continue;
          // Can the camera see that point at all? Bodies hide their insides.
          bool hidden = false;
          for (std::uint32_t other = 0; other < 3 && !hidden; ++other) {
            for (std::size_t f = 0; f < scene.triangleCount(other) && !hidden; ++f) {
              const double way = meets(scene.triangle(other, f), camera.eyeWorld, from, -1e-4);
              hidden = way > 0.0 && way < 1.0 - 1e-6;
            }
          }
          if (hidden) continue;
          if (kept) {
            ++hitsOfKept;
            break;
          }
          ++hits;
          ADD_FAILURE() << "round " << round << ": caster " << caster << " shadows " << receiver;
        }
      }
    }
    ASSERT_EQ(hits, 0);
  }
  // The test means nothing unless many are left out and rays hit often.
  EXPECT_GT(leftOut, 2000);
  EXPECT_GT(hitsOfKept, 2000);
}

}  // namespace
}  // namespace halfshadow::planner
