// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "reference/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flat_scenes.hpp"

namespace halfshadow {
namespace {

using reference::ReceiverImage;
using test::parallelogram;
using test::receiverGrid;

const scene::AreaLight kLight{.centerWorld = {0, 4, 0}, .halfU = {0, 0, 0.5}, .halfV = {0.5, 0, 0}};

scene::SceneDescription plateScene() {
  scene::SceneDescription scene{.name = "plate"};
  scene.objects.push_back(parallelogram("plate", {0.1, 1, 0.2}, {0.4, 0.1, 0.2}, {-0.1, 0.1, 0.5}));
  scene.objects.push_back(parallelogram("ground", {0, 0, 0}, {0, 0, 5}, {5, 0, 0}));
  scene.objects.back().casts = false;
  return scene;
}

ReceiverImage groundGrid(int side) {
  return receiverGrid(side, {0, 0, 0}, {0, 0, 2}, {2, 0, 0});
}

std::vector<float> traced(const scene::SceneDescription& scene, const scene::AreaLight& light,
                          const ReceiverImage& receivers, const reference::ReferenceOptions& options) {
  Result<std::vector<float>> visibility = reference::traceVisibility(scene, light, receivers, options);
  EXPECT_TRUE(visibility.ok()) << visibility.error().message;
  return visibility.ok() ? *visibility : std::vector<float>();
}

TEST(Reference, ThreadsAndSubsetsDoNotChangeAPixel) {
  const scene::SceneDescription scene = plateScene();
  const ReceiverImage receivers = groundGrid(20);
  const std::vector<float> one = traced(scene, kLight, receivers, {.samples = 64, .threads = 1});
  EXPECT_EQ(one, traced(scene, kLight, receivers, {.samples = 64, .threads = 2}));
  EXPECT_EQ(one, traced(scene, kLight, receivers, {.samples = 64, .threads = 7}));
  EXPECT_NE(one, traced(scene, kLight, receivers, {.samples = 64, .seed = 2}));
  const std::vector<std::uint32_t> pixels{399, 0, 210, 211};
  const auto some = reference::tracePixels(scene, kLight, receivers, pixels, {.samples = 64});
  ASSERT_TRUE(some.ok());
  for (std::size_t i = 0; i < pixels.size(); ++i) EXPECT_EQ((*some)[i], one[pixels[i]]);
}

TEST(Reference, ProgressRisesToOne) {
  std::vector<double> shares;
  reference::ReferenceOptions options{.samples = 4, .threads = 2};
  options.progress = [&](double share) { shares.push_back(share); };
  traced(plateScene(), kLight, groundGrid(20), options);
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
}

TEST(Reference, PointLightIsHard) {
  scene::AreaLight point = kLight;
  point.halfU = point.halfV = glm::dvec3(0.0);
  scene::SceneDescription scene;
  scene.objects.push_back(parallelogram("plate", {0, 2, 0}, {0, 0, 0.5}, {0.5, 0, 0}));
  const ReceiverImage receivers = groundGrid(20);
  const std::vector<float> visibility = traced(scene, point, receivers, {});
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    // Half the height: the shadow is the square |x|, |z| < 1. No receiver of the grid lies on its border.
    const glm::dvec3 position = receivers.positionWorld[i];
    const bool shadowed = std::abs(position.x) < 1 && std::abs(position.z) < 1;
    EXPECT_EQ(visibility[i], shadowed ? 0.0f : 1.0f) << position.x << " " << position.z;
  }
}

TEST(Reference, BehindTheLightNothingIsHidden) {
  // A plate across the light's plane, receivers on a wall on both sides of it: light.hpp's convention.
  scene::SceneDescription scene;
  scene.objects.push_back(parallelogram("plate", {1, 4, 0}, {0, 3, 0}, {0, 0, 3}));
  for (const double size : {0.0, 0.5}) {
    scene::AreaLight light = kLight;
    light.halfU *= size, light.halfV *= size;
    const ReceiverImage receivers = receiverGrid(20, {2, 4, 0}, {0, 2, 0}, {0, 0, 2});
    const std::vector<float> visibility = traced(scene, light, receivers, {.samples = 16});
    for (std::size_t i = 0; i < visibility.size(); ++i) {
      EXPECT_EQ(visibility[i], receivers.positionWorld[i].y > 4.0 ? 1.0f : 0.0f) << "size " << size;
    }
  }
}

TEST(Reference, OnlyCastersShadow) {
  scene::SceneDescription scene = plateScene();
  scene.objects[0].casts = false;
  for (const float v : traced(scene, kLight, groundGrid(8), {.samples = 16})) EXPECT_EQ(v, 1.0f);
  ReceiverImage none = groundGrid(8);
  std::fill(none.kind.begin(), none.kind.end(), std::uint8_t{reference::kNoReceiver});
  for (const float v : traced(plateScene(), kLight, none, {.samples = 16})) EXPECT_EQ(v, 1.0f);
}

TEST(Reference, TinyScenesFarFromTheOriginKeepTheirVisibility) {
  const ReceiverImage receivers = groundGrid(24);
  const std::vector<float> expected = traced(plateScene(), kLight, receivers, {.samples = 256});
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const double shift : {0.0, 1e4}) {
      const auto moved = [&](const glm::dvec3& p) { return p * scale + glm::dvec3(shift, 0.0, shift); };
      scene::SceneDescription scene = plateScene();
      for (scene::SceneObject& object : scene.objects) {
        for (std::size_t axis = 0; axis < 3; ++axis) object.worldFromObject[axis] *= scale;
        object.worldFromObject[3] = glm::dvec4(moved(glm::dvec3(object.worldFromObject[3])), 1.0);
      }
      const scene::AreaLight light{.centerWorld = moved(kLight.centerWorld),
                                   .halfU = kLight.halfU * scale,
                                   .halfV = kLight.halfV * scale};
      ReceiverImage movedReceivers = receivers;
      for (glm::dvec3& position : movedReceivers.positionWorld) position = moved(position);
      const std::vector<float> visibility = traced(scene, light, movedReceivers, {.samples = 256});
      ASSERT_EQ(visibility.size(), expected.size());
      // The same seed gives the same light points: only rays that graze an edge within rounding may change,
      // one of 256 for each such ray.
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(visibility[i], expected[i], 1.5 / 256) << "scale " << scale << " shift " << shift;
      }
    }
  }
}

TEST(Reference, NoiseFallsFasterThanByTheRootOfTheSamples) {
  const scene::SceneDescription scene = plateScene();
  const ReceiverImage receivers = groundGrid(40);
  double noise[2];
  int i = 0;
  for (const int samples : {64, 1024}) {
    const reference::ReferenceOptions options{.samples = samples};
    const std::vector<float> visibility = traced(scene, kLight, receivers, options);
    const Result<double> rmse = reference::noiseRmse(scene, kLight, receivers, visibility, options);
    ASSERT_TRUE(rmse.ok());
    noise[i++] = *rmse;
  }
  // Random points would gain sqrt(16) = 4; jittered strata gain 16^(3/4) = 8 on straight edges.
  EXPECT_GT(noise[0] / noise[1], 5.0);
  EXPECT_GT(noise[1], 0.0);
}

TEST(Reference, SamplesAreRoundedUpToWholeStrata) {
  EXPECT_EQ(reference::tracedSamples(4096), 4096);
  EXPECT_EQ(reference::tracedSamples(1), 1);
  EXPECT_EQ(reference::tracedSamples(7), 9);
  EXPECT_EQ(reference::tracedSamples(12), 12);
  EXPECT_EQ(reference::tracedSamples(0), 0);
}

TEST(Receivers, KindsPositionsAndNormals) {
  scene::SceneDescription scene = plateScene();
  scene.objects.push_back(parallelogram("wall", {0, 1, -4.9}, {4, 0, 0}, {0, 1, 0}));
  scene.objects.back().receives = false;
  const scene::Camera camera{.eyeWorld = {0, 6, 4}, .targetWorld = {0, 0.8, -1}};
  const Result<ReceiverImage> image = reference::traceReceivers(scene, camera, kLight, 48, 36);
  ASSERT_TRUE(image.ok()) << image.error().message;
  int counts[3] = {0, 0, 0};
  for (std::size_t i = 0; i < image->kind.size(); ++i) {
    ++counts[image->kind[i]];
    if (image->kind[i] == reference::kNoReceiver) continue;
    const glm::dvec3 position = image->positionWorld[i];
    const glm::dvec3 direction =
        scene::pixelRayWorld(camera, 48, 36, static_cast<double>(i % 48), static_cast<double>(i / 48));
    EXPECT_NEAR(glm::length(glm::cross(position - camera.eyeWorld, direction)), 0.0, 1e-12) << "off its ray";
    EXPECT_LT(glm::dot(glm::dvec3(image->normalWorld[i]), direction), 0.0) << "normal away from the camera";
    if (image->kind[i] == reference::kGroundReceiver) {
      EXPECT_NEAR(position.y, 0.0, 1e-12);
      EXPECT_NEAR(image->normalWorld[i].y, 1.0f, 1e-6f);
    } else {
      const glm::dvec3 plateNormal = glm::cross(glm::dvec3(0.4, 0.1, 0.2), glm::dvec3(-0.1, 0.1, 0.5));
      EXPECT_NEAR(glm::dot(position - glm::dvec3(0.1, 1, 0.2), plateNormal), 0.0, 1e-12);
    }
  }
  EXPECT_GT(counts[reference::kNoReceiver], 20) << "the wall does not receive, the sky is empty";
  EXPECT_GT(counts[reference::kGroundReceiver], 400);
  EXPECT_GT(counts[reference::kCasterReceiver], 20);
}

TEST(Receivers, SurfacesTurnedFromTheLightAreNone) {
  const scene::Camera below{.eyeWorld = {0.5, -3, 0.5}, .targetWorld = {0, 0, 0}, .up = {0, 0, 1}};
  const Result<ReceiverImage> image = reference::traceReceivers(plateScene(), below, kLight, 8, 6);
  ASSERT_TRUE(image.ok());
  for (std::size_t i = 0; i < image->kind.size(); ++i) {
    EXPECT_EQ(image->kind[i], reference::kNoReceiver);
    EXPECT_NEAR(image->normalWorld[i].y, -1.0f, 1e-6f) << "seen from below, the ground faces down";
  }
}

TEST(Reference, CancelledItStopsAndWhatItTracedIsRight) {
  const scene::SceneDescription scene = plateScene();
  const ReceiverImage receivers = groundGrid(64);
  reference::ReferenceOptions options{.samples = 16, .threads = 1};
  const auto whole = reference::traceVisibility(scene, kLight, receivers, options);
  ASSERT_TRUE(whole.ok());
  int asked = 0;
  options.isCancelled = [&] { return ++asked > 70; };
  const auto part = reference::traceVisibility(scene, kLight, receivers, options);
  ASSERT_TRUE(part.ok());
  EXPECT_EQ(asked, 71) << "nothing is done once it was cancelled";
  std::size_t same = 0, left = 0;
  for (std::size_t i = 0; i < whole->size(); ++i) {
    same += (*part)[i] == (*whole)[i] ? 1 : 0;
    left += (*part)[i] != (*whole)[i] && (*part)[i] == 1.0f ? 1 : 0;
  }
  EXPECT_EQ(same + left, whole->size());
  EXPECT_GT(left, 0u);
}

TEST(Reference, WrongArgumentsAreRefusedWithASentence) {
  const scene::SceneDescription scene = plateScene();
  const ReceiverImage receivers = groundGrid(4);
  EXPECT_EQ(reference::traceVisibility(scene, kLight, receivers, {.samples = 0}).error().code,
            ErrorCode::invalidArgument);
  scene::AreaLight nowhere = kLight;
  nowhere.halfU.x = std::nan("");
  EXPECT_EQ(reference::traceVisibility(scene, nowhere, receivers, {}).error().code, ErrorCode::invalidLight);
  const std::vector<std::uint32_t> outside{16};
  EXPECT_EQ(reference::tracePixels(scene, kLight, receivers, outside, {}).error().code,
            ErrorCode::invalidArgument);
  EXPECT_EQ(reference::noiseRmse(scene, kLight, receivers, {}, {}).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(reference::traceReceivers(scene, {}, kLight, 0, 4).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(reference::traceReceivers({}, {}, kLight, 4, 4).error().code, ErrorCode::emptyScene);
  EXPECT_EQ(reference::traceReceivers(scene, {.verticalFovRadians = 0}, kLight, 4, 4).error().code,
            ErrorCode::invalidCamera);
}

}  // namespace
}  // namespace halfshadow
