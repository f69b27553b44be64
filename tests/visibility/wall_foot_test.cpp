// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The foot of a wall that hides the whole light from the ground behind it: dark by similar triangles, however
// much wider a region the wall's upper parts ask to be filtered. And decisions about a receiver do not change
// with a turn of the scene.
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "api/receiver_reach.hpp"
#include "reference/reference.hpp"

namespace halfshadow::test {
namespace {
constexpr int kFootWidth = 128, kFootHeight = 96;
constexpr double kWallHeight = 4.0, kLightHeight = 9.0;

struct Wall {
  double lightX;     ///< of its centre; it is two wide, the wall at 0
  double thickness;  ///< behind the plane x = 0
  bool groundCasts;
};

class WallFoot : public SharedEngineTest {
 protected:
  static scene::SceneDescription scene(const Wall& wall) {
    scene::SceneDescription scene;
    scene.objects.push_back(boxObject({-0.5 * wall.thickness, 0.5 * kWallHeight, 0},
                                      {0.5 * wall.thickness, 0.5 * kWallHeight, 3.0}));
    scene.objects.push_back(groundPlane(8.0));
    scene.objects.back().casts = wall.groundCasts;
    scene.camera = scene::Camera{
        .eyeWorld = {-6, 4, 2.5}, .targetWorld = {-0.4, 0, 0}, .verticalFovRadians = glm::radians(30.0)};
    const auto light =
        scene::areaLightAimed({wall.lightX, kLightHeight, 0}, {wall.lightX, 0, 0}, 2.0, 2.0, {0, 0, 1});
    EXPECT_TRUE(light.ok());
    scene.lights = {*light};
    return scene;
  }
};

TEST_F(WallFoot, IsDarkWhereTheWallHidesTheLight) {
  for (const char* technique : {"pcss", "pcss-mip", "pcf-quantized"}) {
    for (const bool casts : {false, true}) {
      for (const double lightX : {1.3, 1.5, 2.0, 3.0}) {
        for (const double thickness : {0.02, 0.1}) {
          const auto tested = scene({lightX, thickness, casts});
          const auto receivers = reference::traceReceivers(tested, *tested.camera, tested.lights.front(),
                                                           kFootWidth, kFootHeight);
          ASSERT_TRUE(receivers) << receivers.error().message;
          renderer().load(tested);
          renderer().choose({technique});
          renderer().desc().target.width = kFootWidth;
          renderer().desc().target.height = kFootHeight;
          const auto visibility = renderer().render().visibility();
          // Where the nearest point of the light is last seen over the wall; a third of that is left to the
          // penumbra beyond, which filters of one width begin too early.
          const double shadow = (lightX - 1.0) * kWallHeight / (kLightHeight - kWallHeight);
          double sum = 0.0, worst = 0.0;
          int count = 0;
          for (std::size_t i = 0; i < visibility.size(); ++i) {
            if (receivers->kind[i] == reference::kNoReceiver) continue;
            const glm::dvec3 at(receivers->positionWorld[i]);
            const double behind = -thickness - at.x;
            if (at.y > 0.01 || std::abs(at.z) > 1.5 || behind < 0.01 || behind > 0.4 * shadow) continue;
            sum += visibility[i], ++count;
            worst = std::max<double>(worst, visibility[i]);
          }
          const double mean = sum / std::max(count, 1);
          std::printf("%-14s light at %.1f, wall %.2f thick, ground %s: mean %.4f, worst %.3f of %d\n",
                      technique, lightX, thickness, casts ? "casts" : "casts not", mean, worst, count);
          ASSERT_GT(count, 30);
          EXPECT_LE(mean, 0.03) << technique << ", light at " << lightX;
        }
      }
    }
  }
}

TEST(ReceiverReach, IsTheSameHoweverTheSceneIsTurned) {
  const auto light = scene::areaLightAimed({3, 12, 2}, {0, 1, 0}, 2.0, 2.0, {0.2, 0.1, 1});
  ASSERT_TRUE(light.ok());
  const scene::SceneObject ground = groundPlane(20.0), box = boxObject({0, 1, 0}, {1, 0.5, 0.5});
  const auto distance = [&](const glm::dmat4& turn) {
    std::vector<glm::dvec3> points;
    for (const std::uint32_t i : box.mesh->indices)
      points.push_back(
          glm::dvec3(turn * box.worldFromObject * glm::dvec4(glm::dvec3(box.mesh->positions[i]), 1.0)));
    scene::AreaLight turned = *light;
    turned.centerWorld = glm::dvec3(turn * glm::dvec4(light->centerWorld, 1.0));
    turned.halfU = glm::dmat3(turn) * light->halfU;
    turned.halfV = glm::dmat3(turn) * light->halfV;
    turned.emission = glm::dmat3(turn) * light->emission;
    const glm::dmat4 worldFromGround = turn * ground.worldFromObject;
    const planner::PlannedObject receiver{
        .boundsWorld = scene::transformed(worldFromGround, scene::boundsOf(*ground.mesh)),
        .mesh = ground.mesh.get(),
        .worldFromObject = worldFromGround};
    return api::receiverFarDistance(planner::fitLight(turned, points, {}), {&receiver, 1});
  };
  const double still = distance(glm::dmat4(1.0));
  EXPECT_GT(still, 10.0);
  for (const double angle : {0.4, 1.1, 2.3, 4.0}) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), angle, glm::normalize(glm::dvec3(1, 2, -0.7)));
    EXPECT_NEAR(distance(turn), still, 1e-6 * still) << angle;
  }
}

}  // namespace
}  // namespace halfshadow::test
