// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What a hand holds stays under the pointer.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "viewer/camera_motion.hpp"
#include "viewer/error_map.hpp"
#include "viewer/light_handles.hpp"

namespace halfshadow::viewer {
namespace {
constexpr double kWidth = 640, kHeight = 480;

scene::Camera someCamera() {
  return {.eyeWorld = {3, 4, 6}, .targetWorld = {0, 1, 0}, .verticalFovRadians = 0.6};
}

TEST(Screen, AgreesWithTheEnginesMatrices) {
  const scene::Camera camera = someCamera();
  const ScreenSpace screen(camera, kWidth, kHeight);
  const glm::dmat4 clip = scene::clipFromView(camera, kWidth / kHeight) * scene::viewFromWorld(camera);
  for (const glm::dvec3 point : {glm::dvec3(0, 0, 0), glm::dvec3(1, 2, -1), glm::dvec3(-2, 0.5, 1)}) {
    const glm::dvec4 place = clip * glm::dvec4(point, 1.0);
    const glm::dvec2 wanted((place.x / place.w * 0.5 + 0.5) * kWidth,
                            (0.5 - place.y / place.w * 0.5) * kHeight);
    const auto pixel = screen.fromWorld(point);
    ASSERT_TRUE(pixel);
    EXPECT_LT(glm::distance(*pixel, wanted), 1e-9);
    const auto back = screen.atDepthOf(*pixel, point);
    ASSERT_TRUE(back);
    EXPECT_LT(glm::distance(*back, point), 1e-9);
  }
  EXPECT_FALSE(screen.fromWorld({6, 7, 12})) << "behind the eye";
}

TEST(Screen, LinesEndAtTheEye) {
  const ScreenSpace screen(someCamera(), kWidth, kHeight);
  const auto whole = screen.lineFromWorld({0, 0, 0}, {1, 0, 0});
  ASSERT_TRUE(whole);
  EXPECT_LT(glm::distance(whole->a, *screen.fromWorld({0, 0, 0})), 1e-9);
  const auto cut = screen.lineFromWorld({0, 0, 0}, {30, 40, 60});
  ASSERT_TRUE(cut) << "half of it is seen";
  EXPECT_TRUE(std::isfinite(cut->b.x + cut->b.y));
  EXPECT_FALSE(screen.lineFromWorld({30, 40, 60}, {31, 40, 60}));
}

TEST(Camera, OrbitKeepsItsDistanceAndStaysBelowThePole) {
  scene::Camera camera = someCamera();
  const double distance = glm::distance(camera.eyeWorld, camera.targetWorld);
  for (int i = 0; i < 400; ++i) {
    orbit(camera, {7.0, i < 200 ? 9.0 : -11.0}, kHeight);
    ASSERT_NEAR(glm::distance(camera.eyeWorld, camera.targetWorld), distance, 1e-9);
    const double height = glm::normalize(camera.eyeWorld - camera.targetWorld).y;
    ASSERT_LT(std::abs(height), 1.0 - 1e-5);
  }
  EXPECT_TRUE(scene::checkCamera(camera).ok());
}

TEST(Camera, OrbitOfAWholePictureIsHalfATurn) {
  scene::Camera camera{.eyeWorld = {0, 0, 5}, .targetWorld = {0, 0, 0}};
  orbit(camera, {kHeight, 0.0}, kHeight);
  EXPECT_LT(glm::distance(camera.eyeWorld, glm::dvec3(0, 0, -5)), 1e-9);
  // What is before the target follows the pointer: dragged to the right, the eye goes to the left.
  scene::Camera little{.eyeWorld = {0, 0, 5}, .targetWorld = {0, 0, 0}};
  orbit(little, {10.0, 0.0}, kHeight);
  EXPECT_LT(little.eyeWorld.x, 0.0);
}

TEST(Camera, PanMovesTheTargetsSurroundingsWithThePointer) {
  scene::Camera camera = someCamera();
  const glm::dvec3 held = camera.targetWorld;
  pan(camera, {35.0, -20.0}, kHeight);
  const auto pixel = ScreenSpace(camera, kWidth, kHeight).fromWorld(held);
  ASSERT_TRUE(pixel);
  EXPECT_LT(glm::distance(*pixel, glm::dvec2(kWidth / 2 + 35, kHeight / 2 - 20)), 1e-9);
}

TEST(Camera, ZoomNeverPassesTheTarget) {
  scene::Camera camera = someCamera();
  for (int i = 0; i < 200; ++i) zoom(camera, 1e9);
  EXPECT_TRUE(std::isfinite(camera.eyeWorld.x));
  scene::Camera back = someCamera();
  zoom(back, 3.0), zoom(back, -3.0);
  EXPECT_LT(glm::distance(back.eyeWorld, someCamera().eyeWorld), 1e-9);
}

scene::AreaLight someLight() {
  return scene::areaLightAimed({1, 5, 1}, {0, 0, 0}, 1.0, 0.6, {0, 1, 0}).value();
}

TEST(Handles, StayUnderThePointer) {
  const ScreenSpace screen(someCamera(), kWidth, kHeight);
  const auto handles = handlesOf({someLight()}, screen);
  ASSERT_EQ(handles.size(), 4u);
  for (const Handle& handle : handles) {
    // A side can only grow along itself: the pointer goes that way.
    const glm::dvec2 along = glm::normalize(handle.pixel - handles[0].pixel);
    const glm::dvec2 to =
        handle.pixel + (handle.kind >= HandleKind::sizeU ? 14.0 * along : glm::dvec2(9, -14));
    const scene::AreaLight light = dragged(someLight(), handle, screen, to);
    EXPECT_NE(light, someLight());
    for (const Handle& after : handlesOf({light}, screen)) {
      if (after.kind != handle.kind || handle.kind == HandleKind::aim) continue;
      EXPECT_LT(glm::distance(after.pixel, to), 1.0) << static_cast<int>(handle.kind);
    }
    EXPECT_NEAR(glm::length(scene::emissionDirection(light)), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(light.halfU, light.halfV), 0.0, 1e-9);
    const glm::dvec3 normal = glm::normalize(glm::cross(light.halfU, light.halfV));
    EXPECT_NEAR(glm::dot(normal, scene::emissionDirection(light)), 1.0, 1e-9) << "sides and emission agree";
  }
}

TEST(Handles, NoSideVanishes) {
  const ScreenSpace screen(someCamera(), kWidth, kHeight);
  for (const Handle& handle : handlesOf({someLight()}, screen)) {
    if (handle.kind < HandleKind::sizeU) continue;
    const scene::AreaLight light = dragged(someLight(), handle, screen, {-5000, 5000});
    EXPECT_GT(glm::length(light.halfU), 0.0);
    EXPECT_GT(glm::length(light.halfV), 0.0);
    EXPECT_GT(glm::dot(glm::cross(light.halfU, light.halfV), someLight().emission), 0.0)
        << "not turned round";
  }
}

TEST(Handles, ThoseBehindTheEyeAreNotDrawn) {
  scene::AreaLight behind = someLight();
  behind.centerWorld = {30, 40, 60};
  EXPECT_TRUE(handlesOf({behind}, ScreenSpace(someCamera(), kWidth, kHeight)).empty());
}

TEST(Lights, FourQuarterTurnsAreNone) {
  scene::AreaLight light = someLight();
  for (int i = 0; i < 4; ++i) light = anotherLight(light, {0.5, 0, -2});
  EXPECT_LT(glm::distance(light.centerWorld, someLight().centerWorld), 1e-12);
  EXPECT_LT(glm::distance(light.halfU, someLight().halfU), 1e-12);
  EXPECT_NE(anotherLight(someLight(), {0, 0, 0}), someLight());
}

TEST(Lights, SwingRoundThePivotAtTheirDistance) {
  const glm::dvec3 pivot(0.5, 0, -2);
  const scene::AreaLight light = swung(someLight(), pivot, {1, 0, 0}, {30, -20}, kHeight);
  EXPECT_NEAR(glm::distance(light.centerWorld, pivot), glm::distance(someLight().centerWorld, pivot), 1e-12);
  EXPECT_NEAR(glm::length(light.halfU), glm::length(someLight().halfU), 1e-12);
  const glm::dvec3 normal = glm::normalize(glm::cross(light.halfU, light.halfV));
  EXPECT_LT(glm::distance(normal, scene::emissionDirection(light)), 1e-12);
  EXPECT_GT(glm::distance(light.centerWorld, someLight().centerWorld), 0.1);
}

TEST(ErrorColours, TellBrightFromDarkAndGrow) {
  const Colour none = errorColour(0.0, 0.1);
  EXPECT_EQ(none.r + none.g + none.b, 0);
  for (double error = 0.01; error <= 0.1; error += 0.01) {
    const Colour bright = errorColour(error, 0.1), dark = errorColour(-error, 0.1);
    EXPECT_GT(bright.r, bright.b);
    EXPECT_GT(dark.b, dark.r);
  }
  const Colour full = errorColour(0.1, 0.1), beyond = errorColour(5.0, 0.1);
  EXPECT_EQ(full.r, beyond.r);
  EXPECT_EQ(full.g, beyond.g);
}

}  // namespace
}  // namespace halfshadow::viewer
