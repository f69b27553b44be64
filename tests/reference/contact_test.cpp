// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Shadows where caster and receiver nearly touch, on a ground that casts itself: the truth follows from the
// light, the receiver and what lies between, whatever else the scene holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flat_scenes.hpp"
#include "reference/closed_forms.hpp"

namespace halfshadow {
namespace {

using reference::ReceiverImage;
using test::parallelogram;
using test::receiverGrid;

const scene::AreaLight kLight{.centerWorld = {0.3, 4, 0.1}, .halfU = {0, 0, 1}, .halfV = {1, 0, 0}};
constexpr int kSamples = 1024;
// Standard deviation where two edges along the light's sides cross it: 2 · 32 of the 32 × 32 strata are
// mixed, each with variance at most 1/4.
const double kDeviation = std::sqrt(2 * 32 * 0.25) / kSamples;

scene::SceneDescription plateOver(double gap, double groundHalfWidth) {
  scene::SceneDescription scene{.name = "plate over a ground that casts"};
  scene.objects.push_back(parallelogram("plate", {0, gap, 0}, {0, 0, 0.2}, {0.2, 0, 0}));
  scene.objects.push_back(
      parallelogram("ground", {0, 0, 0}, {0, 0, groundHalfWidth}, {groundHalfWidth, 0, 0}));
  return scene;
}

/// Around the plate's edge, as wide as the penumbra below it.
ReceiverImage receiversAtEdge(double gap) {
  ReceiverImage receivers = receiverGrid(24, {0.2, 0, 0}, {0, 0, 0.4 * gap}, {0.4 * gap, 0, 0});
  std::ranges::fill(receivers.kind, std::uint8_t{reference::kCasterReceiver});
  return receivers;
}

std::vector<float> traced(const scene::SceneDescription& scene, const ReceiverImage& receivers) {
  auto visibility = reference::traceVisibility(scene, kLight, receivers, {.samples = kSamples});
  EXPECT_TRUE(visibility.ok()) << visibility.error().message;
  return visibility.ok() ? *visibility : std::vector<float>();
}

TEST(ContactShadows, MatchTheClosedFormAtAnyGap) {
  for (const double gap : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    const ReceiverImage receivers = receiversAtEdge(gap);
    const std::vector<float> visibility = traced(plateOver(gap, 7.05), receivers);
    ASSERT_EQ(visibility.size(), receivers.kind.size());
    int penumbra = 0;
    for (std::size_t i = 0; i < visibility.size(); ++i) {
      // The plate's height and half width are floats of its own matrix: exact here.
      const double exact =
          reference::rectangleVisibility(kLight, receivers.positionWorld[i], {0, gap, 0}, 0.2, 0.2);
      EXPECT_NEAR(visibility[i], exact, 5 * kDeviation) << "gap " << gap << " receiver " << i;
      penumbra += exact > 0.05 && exact < 0.95;
    }
    EXPECT_GT(penumbra, 100) << "gap " << gap;
  }
}

TEST(ContactShadows, DoNotDependOnWhatElseTheSceneHolds) {
  constexpr double kGap = 1e-3;
  const ReceiverImage receivers = receiversAtEdge(kGap);
  const std::vector<float> expected = traced(plateOver(kGap, 7.05), receivers);
  const auto expectEqual = [&](const scene::SceneDescription& scene, const std::string& what) {
    const std::vector<float> visibility = traced(scene, receivers);
    ASSERT_EQ(visibility.size(), expected.size());
    // The same light points: a ray that grazes an edge within rounding may change.
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(visibility[i], expected[i], 1.5 / kSamples) << what << ", receiver " << i;
    }
  };
  for (const double halfWidth : {7.1, 70.5, 71.0, 7.05e3, 7.05e5}) {
    expectEqual(plateOver(kGap, halfWidth), "ground " + std::to_string(halfWidth));
  }
  for (const double distance : {1e2, 1e3, 1e5, 1e7}) {
    scene::SceneDescription scene = plateOver(kGap, 7.05);
    scene.objects.push_back(parallelogram("far", {distance, 1, distance}, {0, 0, 1}, {1, 0, 0}));
    expectEqual(scene, "far caster " + std::to_string(distance));
  }
}

TEST(ContactShadows, SurfacesInOnePlaceDoNotShadowEachOther) {
  // Two grounds in the same place, one of them through another matrix: rotated, and scaled by a third.
  scene::SceneDescription scene = plateOver(1.0, 5.0);
  scene.objects.erase(scene.objects.begin());
  scene::SceneObject twin = parallelogram("twin", {0, 0, 0}, {3.1, 0, 4.7}, {4.7, 0, -3.1});
  auto mesh = std::make_shared<scene::TriangleMesh>(*twin.mesh);
  for (glm::vec3& position : mesh->positions) position *= 3.0f;
  twin.mesh = mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) twin.worldFromObject[axis] /= 3.0;
  scene.objects.push_back(twin);
  ReceiverImage receivers = receiverGrid(24, {0, 0, 0}, {0, 0, 3}, {3, 0, 0});
  std::ranges::fill(receivers.kind, std::uint8_t{reference::kCasterReceiver});
  for (const float v : traced(scene, receivers)) EXPECT_EQ(v, 1.0f);
  // Nothing else is forgiven: a hair above, the second one hides the light.
  scene.objects.back().worldFromObject[3].y = 1e-5;
  for (const float v : traced(scene, receivers)) EXPECT_EQ(v, 0.0f);
}

}  // namespace
}  // namespace halfshadow
