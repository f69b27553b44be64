// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "reference/closed_forms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "flat_scenes.hpp"
#include "reference/reference.hpp"

namespace halfshadow {
namespace {

using test::parallelogram;
using test::receiverGrid;

constexpr int kSamples = 4096;
// Standard deviation when one straight edge along a side of the light crosses it: 64 of the 64 × 64 strata
// are mixed, each with variance at most 1/4.
const double kOneEdgeDeviation = std::sqrt(64 * 0.25) / 4096;

TEST(ClosedForms, HalfPlaneByHand) {
  // Light 2 x 2 at height 4, edge at height 2: the receiver's shift s moves the edge on the light by -s.
  const scene::AreaLight light{.centerWorld = {0, 4, 0}, .halfU = {1, 0, 0}, .halfV = {0, 0, 1}};
  const glm::dvec3 edge(0.0, 2.0, 0.0);
  EXPECT_DOUBLE_EQ(reference::halfPlaneVisibility(light, {0, 0, 0}, edge), 0.5);
  EXPECT_DOUBLE_EQ(reference::halfPlaneVisibility(light, {-0.5, 0, 3}, edge), 0.75);
  EXPECT_DOUBLE_EQ(reference::halfPlaneVisibility(light, {2, 0, 0}, edge), 0.0);
  EXPECT_DOUBLE_EQ(reference::halfPlaneVisibility(light, {-2, 0, 0}, edge), 1.0);
  EXPECT_DOUBLE_EQ(reference::halfPlaneVisibility(light, {0.5, 3, 0}, edge), 1.0)
      << "edge below the receiver";
}

TEST(ClosedForms, RectangleByHand) {
  const scene::AreaLight light{.centerWorld = {0, 4, 0}, .halfU = {1, 0, 0}, .halfV = {0, 0, 1}};
  // Seen from the ground, a rectangle at half the height covers twice its size on the light.
  EXPECT_DOUBLE_EQ(reference::rectangleVisibility(light, {0, 0, 0}, {0, 2, 0}, 0.25, 0.25), 0.75);
  EXPECT_DOUBLE_EQ(reference::rectangleVisibility(light, {1, 0, 0}, {0, 2, 0}, 0.25, 0.25), 0.875);
  EXPECT_DOUBLE_EQ(reference::rectangleVisibility(light, {0, 0, 0}, {0, 2, 0}, 0.5, 0.5), 0.0);
  EXPECT_DOUBLE_EQ(reference::rectangleVisibility(light, {0, 0, 0}, {0, 5, 0}, 1, 1), 1.0);
}

TEST(ClosedForms, TracedHalfPlaneAgrees) {
  const scene::AreaLight light{.centerWorld = {1, 10, -2}, .halfU = {0.6, 0, 0.8}, .halfV = {-0.8, 0, 0.6}};
  const glm::dvec3 u = glm::normalize(light.halfU), v = glm::normalize(light.halfV);
  const glm::dvec3 edge(0.3, 4.0, 0.2);
  scene::SceneDescription scene;
  scene.objects.push_back(parallelogram("half-plane", edge + 50.0 * u, 50.0 * u, 50.0 * v));
  const reference::ReceiverImage receivers = receiverGrid(24, {0, 0, 1}, {1.5, 0, 0}, {0, 0, -1.5});
  const auto traced = reference::traceVisibility(scene, light, receivers, {.samples = kSamples});
  ASSERT_TRUE(traced.ok()) << traced.error().message;
  double errorSum = 0.0;
  int penumbraPixels = 0;
  for (std::size_t i = 0; i < traced->size(); ++i) {
    const double exact = reference::halfPlaneVisibility(light, receivers.positionWorld[i], edge);
    penumbraPixels += exact > 0.005 && exact < 0.995;
    EXPECT_NEAR((*traced)[i], exact, 5 * kOneEdgeDeviation) << "receiver " << i;
    errorSum += (*traced)[i] - exact;
  }
  EXPECT_GT(penumbraPixels, 100);
  EXPECT_NEAR(errorSum / 576, 0.0, 5 * kOneEdgeDeviation / std::sqrt(static_cast<double>(penumbraPixels)));
}

TEST(ClosedForms, TracedThinBoxUnderTiltedLightAgrees) {
  const auto light = scene::areaLightAimed({3, 12, 2}, {0, 1, 0}, 2.0, 1.4, {0.2, 0.1, 1});
  ASSERT_TRUE(light.ok());
  const glm::dvec3 u = glm::normalize(light->halfU), v = glm::normalize(light->halfV);
  const glm::dvec3 toLight = -scene::emissionDirection(*light);
  const glm::dvec3 center(0.2, 2.0, -0.1);
  const double lengthU = 0.5, lengthV = 0.21;
  // Two sheets 1e-6 apart stand for a box: thick enough to be distinct, thin enough to be a rectangle.
  scene::SceneDescription scene;
  scene.objects.push_back(parallelogram("top", center + 1e-6 * toLight, lengthU * u, lengthV * v));
  scene.objects.push_back(parallelogram("bottom", center, lengthV * v, lengthU * u));
  const reference::ReceiverImage receivers = receiverGrid(24, {-0.4, 0, -0.5}, {0.9, 0, 0}, {0, 0, -0.9});
  const auto traced = reference::traceVisibility(scene, *light, receivers, {.samples = kSamples});
  ASSERT_TRUE(traced.ok()) << traced.error().message;
  int penumbraPixels = 0;
  for (std::size_t i = 0; i < traced->size(); ++i) {
    const double exact =
        reference::rectangleVisibility(*light, receivers.positionWorld[i], center, lengthU, lengthV);
    penumbraPixels += exact > 0.005 && exact < 0.995;
    // Up to four edges: twice the deviation of one.
    EXPECT_NEAR((*traced)[i], exact, 5 * 2 * kOneEdgeDeviation) << "receiver " << i;
  }
  EXPECT_GT(penumbraPixels, 100);
}

}  // namespace
}  // namespace halfshadow
