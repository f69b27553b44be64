// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "hard_truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

#include "reference/reference.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {
/// sin(1.5°): facets closer to the light's or the eye's ray have no depth to tell them from their neighbours.
constexpr double kGrazing = 0.026;
/// Of the receivers: outlines are about 1 in 50 pixels of these images, and of those a few are cut by the
/// exact outline within the rasteriser's 1/256 of a pixel.
constexpr double kOutlineShare = 0.004;
/// SwiftShader's vertices snap to 1/16; where clipped at the near plane, long outlines move by up to a pixel.
constexpr double kOutlineShareAngle = 0.01;

bool onAngle() {
  const char* driver = std::getenv("HALFSHADOW_TEST_DRIVER");
  return driver != nullptr && std::string(driver) == "angle";
}
}  // namespace

int allowedSlivers(int surfacesInLine) {
  return onAngle() ? std::max(4, surfacesInLine / 4) : 0;
}

HardTruth hardTruth(const scene::SceneDescription& scene, std::size_t lightIndex) {
  scene::AreaLight light = scene.lights.at(lightIndex);
  light.emission = scene::emissionDirection(light);
  light.halfU = light.halfV = glm::dvec3(0.0);
  const auto receivers = reference::traceReceivers(scene, *scene.camera, light, kWidth, kHeight);
  EXPECT_TRUE(receivers) << receivers.error().message;
  const auto visibility = reference::traceVisibility(scene, light, *receivers, {.samples = 1, .threads = 1});
  EXPECT_TRUE(visibility) << visibility.error().message;
  HardTruth truth;
  const std::size_t pixels = receivers->kind.size();
  truth.receiver.resize(pixels);
  truth.lit.resize(pixels);
  truth.certain.assign(pixels, 0);
  for (std::size_t i = 0; i < pixels; ++i) {
    truth.receiver[i] = receivers->kind[i] != reference::kNoReceiver;
    truth.lit[i] = (*visibility)[i] > 0.5f;
  }
  const glm::dvec3 forward = glm::normalize(scene.camera->targetWorld - scene.camera->eyeWorld);
  const auto depth = [&](std::size_t i) {
    return glm::dot(receivers->positionWorld[i] - scene.camera->eyeWorld, forward);
  };
  const double pixelAngle = 2.0 * std::tan(0.5 * scene.camera->verticalFovRadians) / kHeight;
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth; ++x) {
      const std::size_t center = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
      if (!truth.receiver[center]) continue;
      bool certain = true;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t near = center + static_cast<std::size_t>(dy * kWidth + dx);
          certain = certain && receivers->kind[near] == receivers->kind[center] &&
                    truth.lit[near] == truth.lit[center] &&
                    std::abs(depth(near) - depth(center)) < 4.0 * std::sqrt(2.0) * pixelAngle * depth(center);
        }
      }
      const glm::dvec3 normal(receivers->normalWorld[center]);
      const glm::dvec3 toLight = glm::normalize(light.centerWorld - receivers->positionWorld[center]);
      truth.certain[center] = certain && std::abs(glm::dot(normal, toLight)) > kGrazing;
    }
  }
  return truth;
}

HardError compareHard(const HardTruth& truth, const Image& image, int channel) {
  HardError error;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (!truth.receiver[i]) continue;
    const int value = image.byte(i, channel);
    EXPECT_TRUE(value == 0 || value == 255) << "pixel " << i << " is " << value;
    const bool wrong = (value == 255) != (truth.lit[i] != 0);
    ++error.receivers;
    error.shadowed += truth.lit[i] == 0;
    error.certain += truth.certain[i];
    (truth.certain[i] ? error.wrongCertain : error.wrongElsewhere) += wrong;
  }
  return error;
}

void expectHard(const std::string& name, const HardTruth& truth, const Image& image, int channel,
                int surfacesInLine) {
  const HardError error = compareHard(truth, image, channel);
  std::printf("%-28s %6d receivers, %6d shadowed, %6d certain; wrong: %d certain, %d at outlines\n",
              name.c_str(), error.receivers, error.shadowed, error.certain, error.wrongCertain,
              error.wrongElsewhere);
  const double outlines = (onAngle() ? kOutlineShareAngle : kOutlineShare) * error.receivers;
  ASSERT_GT(error.certain, error.receivers / 3) << name << ": the scene must show something";
  EXPECT_LE(error.wrongCertain, allowedSlivers(surfacesInLine)) << name;
  EXPECT_LE(error.wrongElsewhere, outlines) << name;
  if (error.wrongCertain <= allowedSlivers(surfacesInLine) && error.wrongElsewhere <= outlines) return;
  std::vector<float> expected(image.pixels(), 1.0f), actual(image.pixels(), 1.0f);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (!truth.receiver[i]) continue;
    expected[i] = truth.lit[i] ? 1.0f : 0.0f;
    actual[i] = static_cast<float>(image.byte(i, channel)) / 255.0f;
  }
  std::printf("%s\n", saveComparison("shadow_volume_" + name, kWidth, kHeight, expected, actual).c_str());
}

scene::SceneDescription transformedScene(const scene::SceneDescription& source, double scale,
                                         const glm::dvec3& shift) {
  scene::SceneDescription scene = source;
  const glm::dmat4 moved = glm::scale(glm::translate(glm::dmat4(1.0), shift), glm::dvec3(scale));
  const auto point = [&](const glm::dvec3& p) { return scale * p + shift; };
  for (scene::SceneObject& object : scene.objects) object.worldFromObject = moved * object.worldFromObject;
  for (scene::AreaLight& light : scene.lights) {
    light.centerWorld = point(light.centerWorld);
    light.halfU *= scale;
    light.halfV *= scale;
  }
  scene::Camera& camera = *scene.camera;
  camera.eyeWorld = point(camera.eyeWorld);
  camera.targetWorld = point(camera.targetWorld);
  camera.nearDistance *= scale;
  camera.farDistance *= scale;
  return scene;
}

}  // namespace halfshadow::test
