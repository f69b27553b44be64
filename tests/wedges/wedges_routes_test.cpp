// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The two ways of drawing wedges: what each costs, when which is taken, and that both give one image.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "analytic_scenes.hpp"
#include "reference/reference.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

Configuration by(const std::string& technique, const std::string& route) {
  return {technique, {{technique + ".route", route}}};
}

bool onAngle() {
  const char* driver = std::getenv("HALFSHADOW_TEST_DRIVER");
  return driver != nullptr && std::string(driver) == "angle";
}

class WedgesRoutes : public SharedEngineTest {
 protected:
  static bool hasPass(const std::string& name) {
    return std::ranges::any_of(renderer().report().passes,
                               [&](const Pass& pass) { return pass.name == name; });
  }
  static bool notes(const std::string& what) { return renderer().report().hasSkip(what, ""); }
};

// A plate of 12 triangles that is not drawn, over a ground of two: the ground's depth, one draw of what the
// plate can shadow, the ground.
TEST_F(WedgesRoutes, AReceiverOfFewTrianglesTakesOneDraw) {
  renderer().load(PlateOverGround{}.scene());
  const Image onScreen = renderer().render(by("wedges", "screen"));
  EXPECT_EQ(renderer().report().passes.size(), 3u);
  EXPECT_TRUE(hasPass("receiver depth"));
  // Depth, both parts of the volume, the ground.
  EXPECT_EQ(renderer().report().draws, 1u + 2u + 1u);
  for (const std::string route : {"receivers", "auto"}) {
    const Image byReceivers = renderer().render(by("wedges", route));
    EXPECT_EQ(renderer().report().passes.size(), 2u);
    EXPECT_EQ(renderer().report().framebufferSwitches, 2u);
    EXPECT_FALSE(hasPass("receiver depth"));
    EXPECT_EQ(renderer().report().draws, 1u + 1u + 1u);
    EXPECT_TRUE(notes("light 0 wedge volumes"));
  }
}

// The same for independent casters: the plate is one piece, multiplied into the visibility at once.
TEST_F(WedgesRoutes, OnePieceIsMultipliedInItsFirstPass) {
  renderer().load(PlateOverGround{}.scene());
  renderer().render(by("wedges-probabilistic", "receivers"));
  EXPECT_EQ(renderer().report().passes.size(), 2u);
  EXPECT_EQ(renderer().report().framebufferSwitches, 2u);
  EXPECT_EQ(renderer().report().draws, 1u + 1u + 1u);
  renderer().render(by("wedges-probabilistic", "screen"));
  EXPECT_EQ(renderer().report().passes.size(), 3u);
  EXPECT_EQ(renderer().report().draws, 1u + 2u + 1u);
}

// Spheres of 762 triangles would take hundreds of draws: they read depth, the ground does not.
TEST_F(WedgesRoutes, AutoBoundsTheDrawsOfDenseReceivers) {
  renderer().load(builtinScene("spheres27@light=1"));
  renderer().render(by("wedges", "receivers"));
  const std::uint64_t forced = renderer().report().draws;
  EXPECT_GT(forced, 27u + 100u);
  EXPECT_EQ(renderer().report().passes.size(), 2u);
  EXPECT_FALSE(hasPass("receiver depth"));
  renderer().render(by("wedges", "screen"));
  const std::uint64_t onScreen = renderer().report().draws;
  renderer().render(by("wedges", "auto"));
  EXPECT_EQ(renderer().report().passes.size(), 3u);
  EXPECT_TRUE(hasPass("receiver depth"));
  EXPECT_TRUE(notes("light 0 wedge volumes for receivers of few triangles"));
  // The ground's footprints, behind all spheres, beside the volumes.
  EXPECT_EQ(renderer().report().draws, onScreen + 1u);
}

// Ground pixels differ by the rounding of stored depth: a step of 255. So do casters, but for faces whose
// plane passes through the light: how much of it is above the face turns with the place of the receiver (1 %
// of the pixels, by up to 9 of 255; without depth they are within 1 of the truth). ANGLE's rasteriser snaps
// vertices to a sixteenth of a pixel, which footprints make good and depth does not.
TEST_F(WedgesRoutes, AllGiveOneImage) {
  if (isForcedOff("highp")) GTEST_SKIP() << "highp is forced off: on the screen positions have 11 bits";
  for (const char* technique : {"wedges", "wedges-probabilistic"}) {
    for (const char* scene : {"spheres27@light=1", "leaves@light=0.3", "figure@light=0.3", "bars@light=2"}) {
      const Truth& truth = truthOf(scene);
      renderer().load(builtinScene(scene));
      const Image onScreen = renderer().render(by(technique, "screen"));
      for (const char* route : {"receivers", "auto"}) {
        const Image image = renderer().render(by(technique, route));
        int ground = 0, differing = 0, largest = 0, others = 0, othersDiffering = 0;
        for (std::size_t i = 0; i < image.pixels(); ++i) {
          if (!truth.interior[i] || truth.kind[i] == reference::kNoReceiver) continue;
          const int difference = std::abs(image.byte(i) - onScreen.byte(i));
          if (truth.kind[i] == reference::kGroundReceiver) {
            ++ground, differing += difference > 2, largest = std::max(largest, difference);
          } else {
            ++others, othersDiffering += difference > 2;
          }
        }
        std::printf("%s %s %s: ground %d of %d, largest %d; casters %d of %d\n", technique, scene, route,
                    differing, ground, largest, othersDiffering, others);
        EXPECT_LE(differing, onAngle() ? ground / 100 : 0) << technique << " " << scene << " " << route;
        EXPECT_LE(largest, onAngle() ? 12 : 2) << technique << " " << scene << " " << route;
        EXPECT_LE(othersDiffering, onAngle() ? others / 12 : others / 100)
            << technique << " " << scene << " " << route;
      }
    }
  }
}

// outlines::Footprints follow what moves: caster, receiver, light; and hold while only the camera does.
TEST_F(WedgesRoutes, WhatMovesIsCutAnew) {
  const scene::SceneDescription plate = PlateOverGround{}.scene();
  scene::SceneDescription scene = plate;
  for (const char* technique : {"wedges", "wedges-probabilistic"}) {
    renderer().load(scene);
    renderer().render(by(technique, "receivers"));
    const auto movedEqualsFresh = [&](const char* what) {
      const Image moved = renderer().render();
      EXPECT_GT(renderer().report().bufferBytesUploaded, 0u) << what;
      renderer().load(scene);
      EXPECT_TRUE(renderer().render().rgba == moved.rgba) << what;
    };
    scene.objects[0].worldFromObject[3].x += 0.3;
    renderer().setTransform(0, scene.objects[0].worldFromObject);
    movedEqualsFresh("caster");
    scene.objects[1].worldFromObject[3].y -= 0.2;
    renderer().setTransform(1, scene.objects[1].worldFromObject);
    movedEqualsFresh("receiver");
    scene.lights[0].centerWorld.z += 0.4;
    renderer().setLights(scene.lights);
    movedEqualsFresh("light");
    renderer().desc().camera.eye[0] += 0.2;
    renderer().render();
    EXPECT_EQ(renderer().report().bufferBytesUploaded, 0u);
    scene = plate;
  }
}

// A floor in front of the near plane, beside and behind the camera: clipped triangles, interpolated varyings.
TEST_F(WedgesRoutes, ReceiversThroughTheCameraPlaneKeepTheirShadows) {
  PlateOverGround plate;
  scene::SceneDescription scene = plate.scene();
  scene.camera = scene::Camera{.eyeWorld = {-2.5, 0.4, 0.3},
                               .targetWorld = {1.0, 0.0, 0.0},
                               .verticalFovRadians = 1.3,
                               .nearDistance = 0.2,
                               .farDistance = 200.0};
  renderer().load(scene);
  for (const char* technique : {"wedges", "wedges-probabilistic"}) {
    const Image picture = renderer().render(by(technique, "receivers"));
    int shadowed = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (scene::pixelRayWorld(*scene.camera, kWidth, kHeight, x, y).y > -0.05) continue;
        const glm::dvec3 ground = groundPoint(*scene.camera, kWidth, kHeight, x, y);
        if (std::max(std::abs(ground.x), std::abs(ground.z)) > 8.0) continue;
        const double truth = plate.visibility(ground);
        shadowed += truth < 0.5;
        ASSERT_NEAR(picture.byte(static_cast<std::size_t>(y * kWidth + x)), 255.0 * truth,
                    onAngle()              ? 8.0
                    : isForcedOff("highp") ? 5.0
                                           : 3.0)
            << technique << " " << x << "," << y;
      }
    }
    EXPECT_GT(shadowed, 1000);
  }
}

}  // namespace
}  // namespace halfshadow::test
