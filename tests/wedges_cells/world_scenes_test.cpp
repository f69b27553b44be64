// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Grounds that cast, rooms seen from within, suns, casters that pierce the ground and casters in casters:
// what lists of silhouettes and faces must not depend on.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "reference/reference.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

using WorldScenes = SharedEngineTest;

scene::AreaLight lightFrom(const glm::dvec3& center, const glm::dvec3& target, double half) {
  const glm::dvec3 away = glm::normalize(target - center);
  const glm::dvec3 u = glm::normalize(glm::cross(glm::dvec3(0.2, 1.0, 0.1), away));
  const auto light = scene::areaLightFromVectors(center, half * u, half * glm::cross(away, u));
  EXPECT_TRUE(light.ok());
  return *light;
}

scene::Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target) {
  return {.eyeWorld = eye, .targetWorld = target, .nearDistance = 0.01, .farDistance = 200.0};
}

/// Pixels of receivers that differ from the ray tracer by more than a tenth.
int wrongPixels(SceneRenderer& renderer, const scene::SceneDescription& scene,
                const Configuration& configuration) {
  const auto receivers = reference::traceReceivers(scene, *scene.camera, scene.lights[0], kWidth, kHeight);
  EXPECT_TRUE(receivers.ok());
  const auto truth =
      reference::traceVisibility(scene, scene.lights[0], *receivers, {.samples = 64, .threads = 2});
  EXPECT_TRUE(truth.ok());
  renderer.load(scene);
  const std::vector<float> actual = renderer.render(configuration).visibility();
  int wrong = 0;
  for (std::size_t k = 0; k < actual.size(); ++k)
    wrong += receivers->kind[k] != reference::kNoReceiver && std::abs(actual[k] - (*truth)[k]) > 0.1f;
  return wrong;
}

int differingPixels(const std::vector<float>& a, const std::vector<float>& b) {
  int differing = 0;
  for (std::size_t k = 0; k < a.size(); ++k) differing += std::abs(a[k] - b[k]) > 2.5f / 255.0f;
  return differing;
}

/// A small box that touches a ground which casts.
scene::SceneDescription contact(double groundHalf) {
  scene::SceneDescription scene{.name = "contact"};
  scene.objects = {boxObject({0, 0.2, 0}, {0.2, 0.2, 0.2}), groundPlane(groundHalf)};
  scene.objects[1].casts = true;
  scene.lights = {lightFrom({1.0, 3.0, 1.0}, {0, 0, 0}, 0.2)};
  scene.camera = cameraAt({1.0, 1.2, 1.5}, {0, 0.1, 0});
  return scene;
}

const Configuration kGathers[] = {{"wedges-cells", {{"wedges-cells.route", "gather"}}},
                                  {"wedges-blended", {{"wedges-blended.merge", "gather"}}}};

TEST_F(WorldScenes, NoWidthOfAGroundAndNoFarCasterMovesAContact) {
  if (isForcedOff("highp")) GTEST_SKIP() << "without highp a place has 11 bits";
  for (const Configuration& configuration : kGathers) {
    const scene::SceneDescription small = contact(7.0);
    EXPECT_LE(wrongPixels(renderer(), small, configuration), 10) << configuration.text();
    renderer().load(small);
    const std::vector<float> expected = renderer().render(configuration).visibility();
    for (const double half : {7.1, 71.0, 7100.0, 70000.0}) {
      // Where no casters meet, blended adds up wedges that receivers carry: interpolation over a triangle as
      // wide as this leaves .004 units, a tenth of this penumbra.
      if (half > 1e4 && configuration.technique == "wedges-blended") continue;
      renderer().load(contact(half));
      EXPECT_LE(differingPixels(renderer().render(configuration).visibility(), expected), 10)
          << configuration.text() << ", ground " << half;
    }
    for (const double distance : {1e3, 1e4, 1e6}) {
      scene::SceneDescription withFar = small;
      withFar.objects.push_back(boxObject({distance, 0.2, 0.0}, {1.0, 1.0, 1.0}));
      renderer().load(withFar);
      EXPECT_LE(differingPixels(renderer().render(configuration).visibility(), expected), 10)
          << configuration.text() << ", with a caster " << distance << " away";
    }
  }
}

TEST_F(WorldScenes, AClosedRoomIsDarkWithin) {
  scene::SceneDescription scene{.name = "house"};
  scene.objects = {boxObject({0, 1.5, 0}, {3.0, 1.5, 2.0})};
  scene.lights = {lightFrom({4.0, 7.0, 3.0}, {0, 0, 0}, 0.5)};
  scene.camera = cameraAt({-2.5, 1.2, -1.5}, {1.0, 1.5, 0.5});
  for (const Configuration& configuration :
       {Configuration{"wedges-cells", {{"wedges-cells.route", "gather"}}},
        Configuration{"wedges-cells", {{"wedges-cells.route", "scatter"}}},
        Configuration{"wedges-blended", {{"wedges-blended.merge", "gather"}}},
        Configuration{"wedges-blended", {{"wedges-blended.merge", "core"}}}}) {
    EXPECT_EQ(wrongPixels(renderer(), scene, configuration), 0) << configuration.text();
    // So it is where a ground lies in the plane of its floor, and with a table, wherever the light stands.
    // What is drawn on the screen has single pixels at the foot of the walls.
    if (configuration.text().find("gather") == std::string::npos) continue;
    for (const glm::dvec3& center : {glm::dvec3(3, 9, 4), glm::dvec3(6, 9, 5), glm::dvec3(-1, 8, 0.5)}) {
      for (const glm::dvec3& target : {glm::dvec3(center.x, 0, center.z), glm::dvec3(0, 0, 0)}) {
        scene::SceneDescription onGround = scene;
        onGround.objects.push_back(boxObject({0.5, 0.4, 0.2}, {0.4, 0.4, 0.4}));
        onGround.objects.push_back(groundPlane(40));
        onGround.lights = {lightFrom(center, target, 0.5)};
        EXPECT_LE(wrongPixels(renderer(), onGround, configuration), 2)
            << configuration.text() << ", light at " << center.x << ", " << center.y << ", " << center.z
            << " to " << target.x;
      }
    }
  }
}

TEST_F(WorldScenes, SunsAreFarLights) {
  if (isForcedOff("highp")) GTEST_SKIP() << "without highp a place has 11 bits";
  for (const Configuration& configuration :
       {kGathers[0], kGathers[1], Configuration{"wedges-cells", {{"wedges-cells.route", "scatter"}}}}) {
    scene::SceneDescription scene{.name = "sun"};
    // Two that overlap, so that wedges-blended has something to blend.
    scene.objects = {boxObject({0, 2.0, 0}, {1.0, 0.2, 0.4}), boxObject({0.2, 3.0, 0}, {0.3, 0.2, 1.2}),
                     groundPlane(20.0)};
    scene.camera = cameraAt({-6.5, 9.0, 1.5}, {-0.7, 0, -0.4});
    std::vector<float> before;
    for (const double distance : {1e5, 1e7}) {
      scene.lights = {
          lightFrom(distance * glm::normalize(glm::dvec3(0.25, 0.95, 0.17)), {0, 0, 0}, 0.08 * distance)};
      EXPECT_LE(wrongPixels(renderer(), scene, configuration), 10)
          << configuration.text() << ", " << distance;
      const std::vector<float> picture = renderer().render(configuration).visibility();
      if (!before.empty()) {
        EXPECT_LE(differingPixels(picture, before), 10) << configuration.text();
      }
      before = picture;
    }
  }
}

TEST_F(WorldScenes, CastersMayPierceTheGround) {
  if (isForcedOff("highp")) GTEST_SKIP() << "without highp a place has 11 bits";
  for (const double turn : {0.3, 0.9, 2.0}) {
    scene::SceneDescription scene{.name = "pierced"};
    scene.objects = {boxObject({0, 0, 0}, {0.5, 0.9, 0.4}), groundPlane(20.0)};
    scene.objects[0].worldFromObject =
        glm::rotate(glm::dmat4(1.0), turn, glm::normalize(glm::dvec3(1.0, 0.4, 0.3)));
    scene.lights = {lightFrom({-6.8, 2.3, -9.9}, {0, 0.5, 0}, 1.0)};
    scene.camera = cameraAt({-4.0, 4.0, 7.7}, {0.3, 0.5, 0.2});
    // Few tiles: their receivers lie at many heights.
    for (const char* tiles : {"4", "16", "128"}) {
      EXPECT_LE(
          wrongPixels(renderer(), scene,
                      {"wedges-cells", {{"wedges-cells.route", "gather"}, {"wedges-cells.tiles", tiles}}}),
          12)
          << turn << ", " << tiles << " tiles";
    }
  }
}

TEST_F(WorldScenes, CastersInsideAnotherAddNothing) {
  scene::SceneDescription scene{.name = "shells"};
  scene.objects = {boxObject({0, 2.0, 0}, {1.0, 0.8, 0.6}), groundPlane(20.0)};
  scene.lights = {lightFrom({3.0, 12.0, 2.0}, {0, 1.0, 0}, 1.0)};
  scene.camera = cameraAt({-6.5, 9.0, 1.5}, {-0.7, 0, -0.4});
  for (const Configuration& configuration : kGathers) {
    renderer().load(scene);
    const std::vector<float> alone = renderer().render(configuration).visibility();
    scene::SceneDescription nested = scene;
    for (int k = 1; k < 12; ++k)
      nested.objects.push_back(boxObject({0, 2.0, 0}, glm::dvec3(1.0, 0.8, 0.6) * (1.0 - 0.05 * k)));
    renderer().load(nested);
    EXPECT_LE(differingPixels(renderer().render(configuration).visibility(), alone), 10)
        << configuration.text();
  }
}

}  // namespace
}  // namespace halfshadow::test
