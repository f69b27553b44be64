// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Rooms that the light is outside of are dark to where their walls meet, however the walls are split into
// meshes.
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "reference/reference.hpp"
#include "scenes/shapes.hpp"
#include "techniques/parts/maps/interiors.hpp"

namespace halfshadow::test {
namespace {
constexpr int kRoomWidth = 128, kRoomHeight = 96;

class Interiors : public SharedEngineTest {
 protected:
  struct Judged {
    double mean = 0.0;
    bool stoodIn = false;
  };
  /// Over what faces the light; all of it is in its shadow.
  Judged judge(const std::vector<scene::SceneObject>& room, const glm::dvec3& lightCenter,
               const std::string& technique) {
    scene::SceneDescription tested;
    tested.objects = room;
    tested.camera = scene::Camera{
        .eyeWorld = {2.0, 2.1, 2.2}, .targetWorld = {-2, 1.9, -2}, .verticalFovRadians = glm::radians(60.0)};
    const auto light = scene::areaLightAimed(lightCenter, {0, 2, 0}, 2.0, 2.0, {0.2, 0.1, 1});
    EXPECT_TRUE(light.ok());
    tested.lights = {*light};
    const auto receivers = reference::traceReceivers(tested, *tested.camera, *light, kRoomWidth, kRoomHeight);
    EXPECT_TRUE(receivers.ok());
    renderer().load(tested);
    renderer().choose({technique});
    renderer().desc().target.width = kRoomWidth;
    renderer().desc().target.height = kRoomHeight;
    const auto visibility = renderer().render().visibility();
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < visibility.size(); ++i) {
      if (receivers->kind[i] == reference::kNoReceiver) continue;
      const glm::dvec3 toLight = light->centerWorld - receivers->positionWorld[i];
      if (glm::dot(glm::dvec3(receivers->normalWorld[i]), toLight) <= 0.0) continue;
      sum += visibility[i], ++count;
    }
    EXPECT_GT(count, 1000);
    return {sum / std::max(count, 1), renderer().report().hasSkip("light 0 " + technique, "takes the light")};
  }
};

scene::SceneObject house() {
  scene::SceneObject object = boxObject({0, 2, 0}, {3, 2, 3});
  object.receives = true;
  return object;
}

TEST_F(Interiors, HousesAreDarkWithin) {
  std::string reason;
  for (const char* technique : {"vsm", "occlusion-textures"}) {
    if (!supports(technique, reason)) continue;
    for (const glm::dvec3& light : {glm::dvec3(6, 12, 4), glm::dvec3(3, 9, 4), glm::dvec3(-8, 10, 1)}) {
      const Judged judged = judge({house()}, light, technique);
      std::printf("%-18s light at %4.1f %4.1f %4.1f: mean %.4f\n", technique, light.x, light.y, light.z,
                  judged.mean);
      EXPECT_LE(judged.mean, 0.01) << technique;
      EXPECT_EQ(judged.stoodIn, std::string(technique) == "vsm") << technique;
    }
  }
}

TEST_F(Interiors, AHouseSeenFromOutsideIsNoInterior) {
  std::string reason;
  if (!supports("vsm", reason)) GTEST_SKIP() << reason;
  scene::SceneObject far = boxObject({-10, 2, -10}, {3, 2, 3});
  far.receives = true;
  EXPECT_FALSE(judge({far, groundPlane(20.0)}, {6, 12, 4}, "vsm").stoodIn);
}

/// Quads by their corners, as one mesh.
scene::SceneObject sheets(const std::vector<std::array<glm::vec3, 4>>& quads) {
  scenes::Shape shape;
  for (const auto& quad : quads) {
    const auto first = static_cast<std::uint32_t>(shape.positions.size());
    shape.positions.insert(shape.positions.end(), quad.begin(), quad.end());
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) shape.indices.push_back(first + corner);
  }
  return scenes::casterOf("sheets", shape);
}

TEST_F(Interiors, ARoomIsOneHoweverItsWallsAreSplit) {
  std::string reason;
  if (!supports("vsm", reason)) GTEST_SKIP() << reason;
  const std::array<glm::vec3, 4> ceiling{{{-3, 4, -3}, {3, 4, -3}, {3, 4, 3}, {-3, 4, 3}}},
      back{{{-3, 0, -3}, {3, 0, -3}, {3, 4, -3}, {-3, 4, -3}}},
      left{{{-3, 0, 3}, {-3, 0, -3}, {-3, 4, -3}, {-3, 4, 3}}},
      floor{{{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}}};
  const glm::dvec3 light(1, 14, 0);
  const std::vector<std::vector<scene::SceneObject>> rooms = {
      {sheets({ceiling, back, left, floor})},
      {sheets({ceiling}), sheets({back}), sheets({left}), sheets({floor})},
      {sheets({ceiling, left}), sheets({back, floor})}};
  for (const auto& room : rooms) {
    const Judged judged = judge(room, light, "vsm");
    std::printf("vsm, a room in %zu meshes: mean %.4f\n", room.size(), judged.mean);
    EXPECT_TRUE(judged.stoodIn) << room.size();
  }
  // Nothing hides a wall that stands alone, nor a ground below it that it does not touch.
  EXPECT_FALSE(judge({sheets({left}), groundPlane(20.0)}, light, "vsm").stoodIn);
}

// Just below the ceiling the wall sees no point of the light past it, by similar triangles.
TEST_F(Interiors, WallsThatShareAnEdgeLeakNothing) {
  const std::array<glm::vec3, 4> ceiling{{{-3, 4, -3}, {3, 4, -3}, {3, 4, 3}, {-3, 4, 3}}},
      back{{{-3, 0, -3}, {3, 0, -3}, {3, 4, -3}, {-3, 4, -3}}};
  for (const glm::dvec3& center : {glm::dvec3(5, 14, 8), glm::dvec3(-3, 12, 5), glm::dvec3(0.4, 9, 3)}) {
    scene::SceneDescription tested;
    tested.objects = {sheets({ceiling}), sheets({back}), groundPlane(8.0)};
    tested.camera = scene::Camera{
        .eyeWorld = {0.3, 3.4, 0.7}, .targetWorld = {0.2, 3.6, -3}, .verticalFovRadians = glm::radians(30.0)};
    const auto light = scene::areaLightAimed(center, {0, 2, 0}, 2.0, 2.0, {0.2, 0.1, 1});
    ASSERT_TRUE(light.ok());
    tested.lights = {*light};
    const auto receivers = reference::traceReceivers(tested, *tested.camera, *light, kRoomWidth, kRoomHeight);
    ASSERT_TRUE(receivers.ok());
    const auto isDark = [&](const glm::dvec3& at) {
      for (const double u : {-1.0, 1.0}) {
        for (const double v : {-1.0, 1.0}) {
          const glm::dvec3 corner = light->centerWorld + u * light->halfU + v * light->halfV;
          const glm::dvec3 passed = at + (corner - at) * ((4.0 - at.y) / (corner.y - at.y));
          if (std::max(std::abs(passed.x), std::abs(passed.z)) > 3.0) return false;
        }
      }
      return true;
    };
    for (const char* technique :
         {"hard", "pcss", "pcss-mip", "pcf-quantized", "shadow-width", "wedges-cells"}) {
      std::string reason;
      if (!supports(technique, reason)) continue;
      renderer().load(tested);
      renderer().choose({technique});
      renderer().desc().target.width = kRoomWidth;
      renderer().desc().target.height = kRoomHeight;
      const auto visibility = renderer().render().visibility();
      double squares = 0.0;
      int count = 0;
      for (std::size_t i = 0; i < visibility.size(); ++i) {
        if (receivers->kind[i] == reference::kNoReceiver) continue;
        const glm::dvec3 at(receivers->positionWorld[i]);
        // A texel of the coarsest map is .02 wide: nearer to the edge no map tells one side from the other.
        if (std::abs(at.z + 3.0) > 1e-3 || at.y > 3.98 || at.y < 3.9 || !isDark(at)) continue;
        squares += static_cast<double>(visibility[i]) * visibility[i], ++count;
      }
      const double rmse = std::sqrt(squares / std::max(count, 1));
      std::printf("%-14s light at %4.1f %4.1f %4.1f: RMSE %.4f of %d\n", technique, center.x, center.y,
                  center.z, rmse, count);
      ASSERT_GT(count, 200);
      EXPECT_LE(rmse, 0.01) << technique;
    }
  }
}

TEST(Parts, TellsWhichSideOfAClosedMeshPointsAre) {
  const auto mesh = house().mesh;
  ASSERT_NE(mesh, nullptr);
  const glm::dvec3 inside(0.5, 1.0, -0.7);
  // Through a face, through the edge between its triangles, through an edge and a corner of the box.
  for (const glm::dvec3& outside : {glm::dvec3(9, 2, 0.3), glm::dvec3(0.5, 9, -0.7), glm::dvec3(5.5, 7, 0),
                                    inside + 4.0 * (glm::dvec3(3, 4, 3) - inside)}) {
    EXPECT_TRUE(techniques::parts(*mesh, inside, outside)) << outside.x;
    EXPECT_TRUE(techniques::parts(*mesh, outside, inside)) << outside.x;
  }
  EXPECT_FALSE(techniques::parts(*mesh, inside, {-1, 3, 2}));
  EXPECT_FALSE(techniques::parts(*mesh, {-9, 2, 0.2}, {9, 2, 0.3}));
  EXPECT_FALSE(techniques::parts(*mesh, {9, 2, 0}, {9, 7, 4}));
}

}  // namespace
}  // namespace halfshadow::test
