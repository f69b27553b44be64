// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Casters beside the light, below the receiver and across the light's plane: what a map seen from the light's
// centre shows of them must not spoil the shadows of the others.
#include <algorithm>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "analytic_scenes.hpp"
#include "metrics/metrics.hpp"
#include "reference/reference.hpp"

namespace halfshadow::test {
namespace {
constexpr int kSceneWidth = 128, kSceneHeight = 96;

class NearCaster : public SharedEngineTest {
 protected:
  struct Judged {
    double rmse = 0.0;
    bool stoodIn = false;
  };

  static scene::SceneDescription scene(const std::vector<scene::SceneObject>& others) {
    scene::SceneDescription scene;
    scene.objects.push_back(boxObject({0, 1.8, 0}, {1.1, 0.35, 0.8}));
    scene.objects.push_back(groundPlane(60.0));
    for (const auto& object : others) scene.objects.push_back(object);
    scene.camera = scene::Camera{
        .eyeWorld = {-6.5, 9, 1.5}, .targetWorld = {-0.7, 0, -0.4}, .verticalFovRadians = glm::radians(34.0)};
    const auto light = scene::areaLightAimed({3, 12, 2}, {0, 1, 0}, 2.0, 2.0, {0.2, 0.1, 1});
    EXPECT_TRUE(light.ok());
    scene.lights = {*light};
    return scene;
  }

  Judged judge(const scene::SceneDescription& tested, const std::string& technique) {
    const scene::AreaLight& light = tested.lights.front();
    const auto receivers =
        reference::traceReceivers(tested, *tested.camera, light, kSceneWidth, kSceneHeight);
    EXPECT_TRUE(receivers.ok());
    std::vector<std::uint32_t> pixels;
    for (std::uint32_t i = 0; i < receivers->kind.size(); ++i) {
      if (receivers->kind[i] != reference::kNoReceiver) pixels.push_back(i);
    }
    const auto truth =
        reference::tracePixels(tested, light, *receivers, pixels, {.samples = 256, .threads = 2});
    EXPECT_TRUE(truth.ok());
    renderer().load(tested);
    renderer().choose({technique});
    renderer().desc().target.width = kSceneWidth;
    renderer().desc().target.height = kSceneHeight;
    const auto visibility = renderer().render().visibility();
    double sum = 0.0;
    int count = 0;
    for (std::size_t j = 0; j < pixels.size(); ++j) {
      const double expected = (*truth)[j];
      if (expected <= 0.005 || expected >= 0.995) continue;
      sum += (visibility[pixels[j]] - expected) * (visibility[pixels[j]] - expected);
      ++count;
    }
    EXPECT_GT(count, 300);
    return {std::sqrt(sum / std::max(count, 1)),
            renderer().report().hasSkip("light 0 " + technique, "caster-near-light")};
  }
};

/// Of 64 points of the light, see accuracy_test.cpp.
constexpr double kSampledAlone = 0.0181;
/// Of the scene without a post by one map, of all three techniques.
constexpr double kOneMapAlone = 0.033;

const char* const kSearching[] = {"pcss", "pcss-mip", "pcf-quantized"};

TEST_F(NearCaster, APostBesideTheLightLeavesOtherShadowsAlone) {
  for (const char* technique : kSearching) {
    const double alone = judge(scene({}), technique).rmse;
    for (const double height : {4.0, 6.0, 9.0, 11.0, 14.0}) {
      const auto post = boxObject({4.5, 0.5 * height, 0}, {0.15, 0.5 * height, 0.15});
      const Judged judged = judge(scene({post}), technique);
      std::printf("%-14s post of %4.1f: %.4f, alone %.4f%s\n", technique, height, judged.rmse, alone,
                  judged.stoodIn ? ", sampled takes the light" : "");
      // 64 hard shadows, of a penumbra as wide as the picture: as good as one map that sees all from the
      // centre.
      const double most = judged.stoodIn ? kOneMapAlone : alone;
      EXPECT_LE(judged.rmse, 1.3 * most) << technique << ", height " << height;
      // Well below the light its penumbra is as wide as others'.
      if (height <= 6.0) {
        EXPECT_FALSE(judged.stoodIn) << technique << ", height " << height;
      }
      // The light's own height is 12; it is 2 wide.
      if (height >= 11.0) {
        EXPECT_TRUE(judged.stoodIn) << technique << ", height " << height;
      }
    }
  }
}

// A chip so near to a small light that the depths of the others leave no room for it in one map: the near
// distance is a thousandth of the farthest.
TEST_F(NearCaster, ACasterBeforeTheMapStillCasts) {
  const glm::dvec3 center(3, 12, 2), toBox = glm::normalize(glm::dvec3(0, 1, 0) - center);
  const auto tested = [&](double distance) {
    const double half = 0.05 * distance;
    auto chip = scene({boxObject(center + distance * toBox, glm::dvec3(half))});
    chip.lights.front().halfU *= 0.1 * distance;
    chip.lights.front().halfV *= 0.1 * distance;
    return chip;
  };
  const double hard = judge(tested(0.05), "hard").rmse;
  for (const double distance : {5e-3, 1e-3, 2e-4}) {
    const double hardHere = judge(tested(distance), "hard").rmse;
    std::printf("hard           chip at %.0e: %.4f, at 5e-2 %.4f\n", distance, hardHere, hard);
    EXPECT_NEAR(hardHere, hard, 0.1 * hard) << distance;
    for (const char* technique : kSearching) {
      const double rmse = judge(tested(distance), technique).rmse;
      std::printf("%-14s chip at %.0e: %.4f\n", technique, distance, rmse);
      EXPECT_LE(rmse, 0.03) << technique << ", " << distance;
    }
  }
}

TEST_F(NearCaster, CastersBelowAReceiverChangeNothing) {
  for (const char* technique : {"pcss", "pcss-mip", "pcf-quantized", "occlusion-textures", "shadow-width"}) {
    const double alone = judge(scene({}), technique).rmse;
    for (const double top : {-0.02, -0.5, -1.0}) {
      auto below = boxObject({-2, top - 0.5, 0}, {0.5, 0.5, 0.5});
      below.receives = true;
      auto floor = boxObject({0, -4.2, 0}, {4, 0.2, 4});  // something that the lower box can shadow
      floor.casts = false, floor.receives = true;
      const Judged judged = judge(scene({below, floor}), technique);
      std::printf("%-14s box below, top %5.2f: %.4f, alone %.4f\n", technique, top, judged.rmse, alone);
      const bool sampled =
          renderer().report().hasSkip(std::string("light 0 ") + technique, "caster-behind-receiver");
      EXPECT_LE(judged.rmse, 1.1 * (sampled ? kSampledAlone : alone)) << technique << ", top " << top;
    }
  }
}

// The same rectangle, its sides named the other way round.
TEST_F(NearCaster, LongLightsAreAlikeWhicheverSideIsNamedFirst) {
  for (const char* technique : kSearching) {
    for (const double share : {0.25, 0.1, 0.05}) {
      scene::SceneDescription tested = scene({});
      scene::AreaLight light = tested.lights.front();
      light.halfU *= 2.0;
      light.halfV *= 2.0 * share;
      tested.lights = {light};
      const double first = judge(tested, technique).rmse;
      const glm::dvec3 u = light.halfU;
      light.halfU = light.halfV;
      light.halfV = -u;
      tested.lights = {light};
      const double second = judge(tested, technique).rmse;
      std::printf("%-14s 1:%2.0f: %.4f and %.4f\n", technique, 1.0 / share, first, second);
      // Taps and steps of the map fall differently on the two; a width from the wrong side gave 2 to 3.5
      // times.
      EXPECT_LE(std::max(first, second), 1.1 * std::min(first, second) + 0.002) << technique << ", " << share;
      EXPECT_LE(first, 0.06) << technique << ", " << share;
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
