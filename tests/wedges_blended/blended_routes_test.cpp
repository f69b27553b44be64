// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// wedges-blended through targets: the figures of gathering by every way of merging, what frames cost, missing
// capabilities.
#include <cmath>

#include "analytic_scenes.hpp"
#include "reference/reference.hpp"
#include "scenes/shapes.hpp"
#include "wedge_accuracy.hpp"

namespace halfshadow::test {
namespace {

Configuration blended(const std::string& merge, const std::string& centres) {
  return {"wedges-blended", {{"wedges-blended.merge", merge}, {"wedges-blended.cog", centres}}};
}

class BlendedRoutes : public WedgeAccuracyTest, public testing::WithParamInterface<const char*> {
 protected:
  static Configuration route(const std::string& centres) { return blended(GetParam(), centres); }
  /// Without highp there are no targets.
  static bool gathers() { return isForcedOff("highp"); }
};

TEST_P(BlendedRoutes, RectanglesReachTheProjectsFigures) {
  const Mean mean = meanError(route("off"));
  EXPECT_LE(mean.rmse, 0.0145 * precision());
  EXPECT_LE(mean.p99, 0.055 * precision());
  if (!gathers()) {
    EXPECT_LE(mean.largest, 0.2);
  }
}

TEST_P(BlendedRoutes, CentresOfGravityReachTheProjectsFigures) {
  const Mean mean = meanError(route("on"));
  EXPECT_LE(mean.rmse, 0.0095 * precision());
  EXPECT_LE(mean.p99, 0.038 * precision());
  if (!gathers()) {
    EXPECT_LE(mean.largest, 0.2);
  }
}

TEST_P(BlendedRoutes, PicturesAreThoseOfGathering) {
  // Bytes, and batches that combine casters in another order than tiles do: what is estimated to be occluded
  // twice depends on it.
  for (const char* scene : {"spheres27@light=0.3", "spheres81@light=2", "bars@light=1", "leaves@light=1",
                            "figure@light=0.3", "figure@light=1"}) {
    const Truth& truth = truthOf(scene);
    for (const char* centres : {"off", "on"}) {
      const std::vector<float> gathered = visibility(scene, blended("gather", centres));
      const std::vector<float> routed = visibility(scene, route(centres));
      double sum = 0.0, largest = 0.0;
      int count = 0;
      for (std::size_t i = 0; i < gathered.size(); ++i) {
        if (!truth.interior[i] || truth.kind[i] != reference::kGroundReceiver) continue;
        const double difference = std::abs(gathered[i] - routed[i]);
        largest = std::max(largest, difference);
        sum += difference * difference;
        ++count;
      }
      const double rmse = std::sqrt(sum / std::max(count, 1));
      std::printf("%-20s %s %-3s differs by %.4f, rmse %.5f\n", scene, GetParam(), centres, largest, rmse);
      EXPECT_LE(rmse, 0.003) << scene << ", " << centres;
      EXPECT_LE(largest, 0.05) << scene << ", " << centres;
    }
  }
}

TEST_P(BlendedRoutes, OneBatchAfterTheOther) {
  if (gathers()) GTEST_SKIP() << "without highp there are no targets";
  for (const char* centres : {"off", "on"}) {
    renderer().load(builtinScene("spheres27@light=1"));
    renderer().render(route(centres));
    const Report& report = renderer().report();
    const std::string merge = GetParam();
    const bool twice = merge == "core" || report.hasSkip("light 0 merge " + merge, "EXT_blend_minmax");
    std::size_t batches = 0;
    for (const Pass& pass : report.passes) batches += pass.name.find("shares of batch") != std::string::npos;
    // Of 27 spheres, so many may shadow the same receiver.
    EXPECT_EQ(batches, 16u);
    // Shares of every batch; what it occludes with those before, from the second; rectangles but of the last,
    // in two passes each from the second without MAX; centres likewise, in one pass each. Receivers twice.
    const std::size_t sides = 4 + (batches - 2) * 4 * (twice ? 2 : 1);
    const std::size_t centrePasses = std::string(centres) == "on" ? 2 * (batches - 1) : 0;
    EXPECT_EQ(report.passes.size(), 2 + batches + (batches - 1) + sides + centrePasses) << centres;
    EXPECT_EQ(report.framebufferSwitches, report.passes.size()) << centres;
    renderer().render();
    EXPECT_EQ(renderer().report().textureBytesUploaded + renderer().report().bufferBytesUploaded, 0u);
  }
}

TEST_P(BlendedRoutes, EachLightHasItsChannel) {
  scene::SceneDescription scene = builtinScene("figure@light=0.3");
  scene::AreaLight second = scene.lights[0];
  second.centerWorld.x = -second.centerWorld.x;
  scene.lights = {second};
  renderer().load(scene);
  const Image alone = renderer().render(route("on"));
  scene.lights = {builtinScene("figure@light=0.3").lights[0], second};
  renderer().load(scene);
  const Image both = renderer().render(route("on"));
  int differing = 0;
  for (std::size_t i = 0; i < both.pixels(); ++i) differing += both.byte(i, 1) != alone.byte(i, 0);
  EXPECT_LE(differing, 20) << "pixels on outlines";
}

INSTANTIATE_TEST_SUITE_P(Merges, BlendedRoutes, testing::Values("core", "minmax", "fetch"));

using BlendedMerges = WedgeAccuracyTest;

TEST_F(BlendedMerges, AllGiveTheSamePicture) {
  // Rectangles are whole bytes whoever unites them. Centres are rounded alike but in different programs.
  for (const char* scene : {"spheres27@light=1", "leaves@light=2"}) {
    for (const char* centres : {"off", "on"}) {
      const std::vector<float> core = visibility(scene, blended("core", centres));
      for (const char* merge : {"minmax", "fetch"}) {
        const std::vector<float> other = visibility(scene, blended(merge, centres));
        double largest = 0.0;
        for (std::size_t i = 0; i < core.size(); ++i) {
          largest = std::max<double>(largest, std::abs(core[i] - other[i]));
        }
        EXPECT_LE(largest, std::string(centres) == "on" ? 2.5 / 255.0 : 0.0) << scene << ", " << merge;
      }
    }
  }
}

TEST_F(BlendedMerges, WhatIsMissingIsNoted) {
  SceneRenderer core(makeEngine({"framebuffer-fetch", "blend-minmax"}));
  core.load(builtinScene("figure@light=1"));
  const Image fetched = core.render(blended("fetch", "off"));
  if (!isForcedOff("highp")) {
    EXPECT_TRUE(core.report().hasSkip("light 0 merge fetch", "framebuffer fetch"));
    EXPECT_TRUE(core.report().hasSkip("light 0 merge fetch", "EXT_blend_minmax"));
  }
  EXPECT_EQ(fetched.rgba, core.render(blended("core", "off")).rgba);
  SceneRenderer withoutHighp(makeEngine({"highp"}));
  withoutHighp.load(builtinScene("figure@light=1"));
  const Image merged = withoutHighp.render(blended("core", "off"));
  EXPECT_TRUE(withoutHighp.report().hasSkip("light 0 merge core", "gathered"));
  EXPECT_EQ(merged.rgba, withoutHighp.render(blended("gather", "off")).rgba);
}

TEST_F(BlendedMerges, LightInsideAClosedCasterLightsNothingOutside) {
  scene::SceneDescription scene{.name = "lamp"};
  // Two boxes below the lamp's, whose shadows meet: there is something to blend.
  scene.objects = {boxObject({0, 4, 0}, {1, 1, 1}), boxObject({-0.5, 1.0, 0}, {0.4, 0.1, 0.4}),
                   boxObject({0.5, 1.5, 0}, {0.4, 0.1, 0.4}), groundPlane(20.0)};
  scene.camera = cameraAbove(0.0, 0.0, 4.0);
  scene.lights = {lightAbove({0, 4, 0}, 0.2, 0.2)};
  renderer().load(scene);
  for (const char* merge : {"core", "minmax", "fetch"}) {
    const Image image = renderer().render(blended(merge, "on"));
    // The corner shows the ground.
    EXPECT_EQ(image.byte(0), 0) << merge;
  }
}

}  // namespace
}  // namespace halfshadow::test
