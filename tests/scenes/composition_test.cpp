// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What the tool adds to a scene, judged by what the camera then sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "scenes/camera_light_options.hpp"
#include "scenes/fitted_camera.hpp"
#include "scenes/scene_source.hpp"
#include "scenes/shapes.hpp"
#include "scenes/triangle_tree.hpp"

namespace halfshadow::scenes {
namespace {

scene::SceneDescription completed(std::vector<scene::SceneObject> objects, const SceneOptions& options = {}) {
  scene::SceneDescription description{.name = "test", .objects = std::move(objects)};
  const Status status = completeScene(description, options);
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
  return description;
}

scene::SceneObject box(const glm::dvec3& center, const glm::dvec3& half) {
  return casterOf("box", boxShape(center, half));
}

bool hasAddedGround(const scene::SceneDescription& description) {
  return std::ranges::any_of(description.objects,
                             [](const auto& o) { return o.name == "ground" && !o.casts; });
}

TEST(FittedCamera, IsTheNearestThatSeesAllPoints) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 40; ++i) points.emplace_back(std::cos(i) * 3, std::sin(2.0 * i) + 50, std::sin(i) * 2);
  const scene::Camera camera = cameraFittedTo(points);
  const glm::dmat4 clip = scene::clipFromView({.eyeWorld = camera.eyeWorld,
                                               .targetWorld = camera.targetWorld,
                                               .verticalFovRadians = camera.verticalFovRadians,
                                               .nearDistance = 0.01,
                                               .farDistance = 1e3},
                                              4.0 / 3.0) *
                          scene::viewFromWorld(camera);
  glm::dvec2 low(9.0), high(-9.0);
  for (const glm::dvec3& point : points) {
    const glm::dvec4 p = clip * glm::dvec4(point, 1.0);
    ASSERT_GT(p.w, 0.0);
    low = glm::min(low, glm::dvec2(p) / p.w), high = glm::max(high, glm::dvec2(p) / p.w);
  }
  EXPECT_GE(std::min(low.x, low.y), -1.0);
  EXPECT_LE(std::max(high.x, high.y), 1.0);
  EXPECT_NEAR(std::max(high.x - low.x, high.y - low.y), 2.0 / 1.05, 1e-6) << "one direction is filled";
  const int filled = high.x - low.x > high.y - low.y ? 0 : 1;
  EXPECT_NEAR(high[filled] + low[filled], 0.0, 1e-6) << "in the middle";
  EXPECT_NEAR(high[1 - filled] + low[1 - filled], 0.0, 0.1) << "about there";
}

TEST(AddedLamp, StandsInTheRoomThatTheCameraIsIn) {
  for (const double size : {0.01, 1.0, 1000.0}) {
    const glm::dvec3 half = size * glm::dvec3(4, 1.5, 3);
    const scene::Camera inside{.eyeWorld = size * glm::dvec3(3, 0.2, 2),
                               .targetWorld = size * glm::dvec3(0, -1, 0)};
    const auto room =
        completed({box({0, 0, 0}, half), box(size * glm::dvec3(0, -1.2, 0), size * glm::dvec3(0.3))},
                  {.camera = inside});
    ASSERT_EQ(room.lights.size(), 1u);
    EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(room.lights[0].centerWorld), half))) << size;
    EXPECT_LT(glm::length(room.lights[0].halfU), size) << "its size follows the scene";
    const TriangleTree tree(room);
    int lit = 0, seen = 0;
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 16; ++x) {
        const glm::dvec3 way = scene::pixelRayWorld(*room.camera, 16, 12, x, y) * (20.0 * size);
        const auto hit = tree.firstOn(room.camera->eyeWorld, way);
        if (hit.triangle == nullptr) continue;
        ++seen;
        lit +=
            !tree.isBetween(room.camera->eyeWorld + way * (hit.share * 0.9999), room.lights[0].centerWorld);
      }
    }
    EXPECT_GT(lit, seen / 2) << size;
  }
  // Outside nothing changes.
  const scene::Camera outside{.eyeWorld = {9, 9, 9}, .targetWorld = {0, 0, 0}};
  const auto open = completed({box({0, 1, 0}, {1, 1, 1})}, {.camera = outside});
  EXPECT_NEAR(glm::length(open.lights[0].centerWorld - glm::dvec3(0, 1, 0)), 3 * std::sqrt(3.0), 1e-9);
}

TEST(AddedGround, ASmallFloorIsAFloor) {
  scene::SceneObject base = casterOf("base", boxShape({0, -0.05, 0}, {1.2, 0.05, 1.2}));
  EXPECT_TRUE(hasAddedGround(completed({box({0, 1, 0}, {0.4, 1, 0.4}), box({3, 2, 0}, {0.1, 2, 0.1})})));
  EXPECT_FALSE(
      hasAddedGround(completed({base, box({0, 1, 0}, {0.4, 1, 0.4}), box({0, 2.5, 0}, {2, 0.2, 0.2})})));
}

TEST(AddedGround, OffRemovesNothingOfAScenesOwn) {
  scene::SceneObject own = casterOf("ground", planeShape({0, 0, 0}, 10.0));
  own.casts = false;
  const auto kept = completed({own, box({0, 1, 0}, {1, 1, 1})}, {.ground = GroundMode::off});
  EXPECT_EQ(kept.objects.size(), 2u);
  EXPECT_EQ(completed({box({0, 1, 0}, {1, 1, 1})}, {.ground = GroundMode::off}).objects.size(), 1u);
}

TEST(UpAxis, GroundLampAndCameraFollowIt) {
  const auto upright = completed({box({1, 2, 3}, {1, 2, 0.5})});
  for (const char* name : {"x", "z", "-y", "-x", "1,2,-0.5"}) {
    const glm::dvec3 up = glm::normalize(*parseUp(name));
    const auto scene = completed({box({1, 2, 3}, {1, 2, 0.5})}, {.up = up});
    EXPECT_EQ(scene.objects[0].mesh->positions, upright.objects[0].mesh->positions);
    const glm::dvec3 center(1, 2, 3);
    EXPECT_GT(glm::dot(scene.lights[0].centerWorld - center, up),
              0.8 * glm::length(scene.lights[0].centerWorld - center))
        << name;
    EXPECT_GT(glm::dot(scene.camera->eyeWorld - center, up), 0.0) << name;
    EXPECT_GT(glm::dot(scene.camera->up, up), 0.99) << name;
    ASSERT_TRUE(hasAddedGround(scene)) << name;
    // Every corner of the ground at one height, none of the box's below it.
    const auto heights = [&](const scene::SceneObject& object) {
      std::pair range{1e9, -1e9};
      for (const glm::vec3& p : object.mesh->positions) {
        const double height =
            glm::dot(glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(p), 1.0)), up);
        range = {std::min(range.first, height), std::max(range.second, height)};
      }
      return range;
    };
    const auto ground = heights(scene.objects.back()), own = heights(scene.objects[0]);
    EXPECT_NEAR(ground.first, ground.second, 1e-4) << name;
    EXPECT_LE(ground.second, own.first + 1e-4) << name;
  }
  for (const char* wrong : {"", "w", "0,0,0", "1,2", "up"}) EXPECT_FALSE(parseUp(wrong).ok()) << wrong;
}

/// One that stands for an orthographic one.
scene::Camera farAway(const scene::Camera& near) {
  const glm::dvec3 way = near.targetWorld - near.eyeWorld;
  scene::Camera camera = near;
  camera.eyeWorld = near.targetWorld - way * 1000.0;
  camera.verticalFovRadians = 2e-4;  // narrow enough that all of its sight begins in the room
  camera.leastNearDistance = 999.0 * glm::length(way);
  return camera;
}

TEST(CamerasFarAway, LookPastWhatTheyStandBehind) {
  const glm::dvec3 half(4, 1.5, 3);
  const std::vector<scene::SceneObject> objects{box({0, 0, 0}, half), box({0, -1.2, 0}, glm::dvec3(0.3))};
  const auto camera = farAway({.eyeWorld = {3, 0.2, 2}, .targetWorld = {0, -1, 0}});
  const auto room = completed(objects, {.camera = camera});
  ASSERT_EQ(room.lights.size(), 1u);
  EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(room.lights[0].centerWorld), half)))
      << "the lamp stands in the room, whose wall is nearer than what is meant to be seen";
  EXPECT_FALSE(hasAddedGround(room)) << "nor is a ground added around it";
}

TEST(CamerasFarAway, KeepTheDepthBufferForTheScene) {
  const auto camera = farAway({.eyeWorld = {0, 5, 8}, .targetWorld = {0, 0, 0}});
  const auto scene = completed({box({0, 1, 0}, glm::dvec3(1)), casterOf("floor", planeShape({0, 0, 0}, 4.0))},
                               {.ground = GroundMode::off, .camera = camera});
  const glm::dmat4 view = scene::viewFromWorld(*scene.camera);
  double nearest = 1e30, farthest = 0.0;
  for (const scene::SceneObject& object : scene.objects) {
    for (const glm::vec3& position : object.mesh->positions) {
      const double depth = -(view * glm::dvec4(glm::dvec3(position), 1.0)).z;
      nearest = std::min(nearest, depth), farthest = std::max(farthest, depth);
    }
  }
  EXPECT_LT(scene.camera->nearDistance, nearest);
  EXPECT_GT(scene.camera->farDistance, farthest);
  EXPECT_LT(scene.camera->farDistance - scene.camera->nearDistance, 1.2 * (farthest - nearest));
}

}  // namespace
}  // namespace halfshadow::scenes
