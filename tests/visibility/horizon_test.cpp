// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Light below the horizon of a closed caster's facet does not reach it: a share of the light's rectangle
// beyond a straight line, the same at every point of a plane face that nothing else shadows.
#include <algorithm>
#include <cmath>

#include "analytic_scenes.hpp"

namespace halfshadow::test {
namespace {

constexpr double kLightHeight = 10.0, kLightHalf = 1.0;
constexpr glm::dvec3 kBoxHalf{0.5, 1.0, 1.0};

/// The face x = .5 of a box below a light whose centre stands `beyond` before the face's plane.
scene::SceneDescription boxBelow(double beyond) {
  scene::SceneDescription scene;
  scene.objects = {groundPlane(6.0), boxObject({0.0, 1.5, 0.0}, kBoxHalf)};
  scene.objects[1].receives = true;
  scene.lights = {lightAbove({0.5 + beyond, kLightHeight, 0.0}, kLightHalf, kLightHalf)};
  scene.camera = scene::Camera{.eyeWorld = {6.0, 1.5, 0.0},
                               .targetWorld = {0.0, 1.5, 0.0},
                               .up = {0.0, 1.0, 0.0},
                               .verticalFovRadians = 0.35};
  return scene;
}

double shareBeyond(double beyond) {
  return std::clamp(0.5 + 0.5 * beyond / kLightHalf, 0.0, 1.0);
}

/// Mean over the middle of the face, which fills the image.
double meanOfFace(const std::vector<float>& visibility) {
  double sum = 0.0;
  int count = 0;
  for (int y = kHeight / 3; y < 2 * kHeight / 3; ++y) {
    for (int x = kWidth / 3; x < 2 * kWidth / 3; ++x, ++count)
      sum += visibility[static_cast<std::size_t>(y * kWidth + x)];
  }
  return sum / count;
}

class Horizon : public SharedEngineTest, public testing::WithParamInterface<std::string> {};

TEST_P(Horizon, HidesItsShareOfTheLight) {
  for (const char* parts : {"1", "2", "3"}) {
    for (const double beyond : {0.2, 0.4, 0.6, 0.9, 1.5}) {
      renderer().load(boxBelow(beyond));
      const auto image = renderer().render(Configuration{GetParam(), {{"sub_lights", parts}}}).visibility();
      // Eight bits, and what a map's texel takes of a face that it sees at 1:16: .05 of the light. Without
      // the horizon the face is lit: up to .4 too bright.
      EXPECT_NEAR(meanOfFace(image), shareBeyond(beyond), 0.05) << parts << " parts, " << beyond << " beyond";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Horizon, testing::Values("pcss", "pcss-mip", "pcf-quantized"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace halfshadow::test
