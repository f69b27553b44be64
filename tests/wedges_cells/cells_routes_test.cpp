// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// wedges-cells through targets: the same picture as gathered, what frames cost, odd lights, missing
// capabilities.
#include <cmath>

#include "analytic_scenes.hpp"
#include "reference/reference.hpp"
#include "scenes/shapes.hpp"
#include "wedge_accuracy.hpp"

namespace halfshadow::test {
namespace {

Configuration cells(const std::string& route, const std::string& bytes = "16") {
  return {"wedges-cells", {{"wedges-cells.route", route}, {"wedges-cells.bytes", bytes}}};
}

class CellsRoutes : public WedgeAccuracyTest, public testing::WithParamInterface<const char*> {
 protected:
  static Configuration route(const std::string& bytes = "16") { return cells(GetParam(), bytes); }
  /// Without highp there are no targets.
  static bool gathers() { return isForcedOff("highp"); }
};

TEST_P(CellsRoutes, SixteenCellsReachTheProjectsFigures) {
  const Mean mean = meanError(route());
  EXPECT_LE(mean.rmse, 0.0062 * precision());
  EXPECT_LE(mean.p99, 0.024 * precision());
  if (!gathers()) {
    EXPECT_LE(mean.largest, 0.072);  // see cells_accuracy_test.cpp
  }
}

TEST_P(CellsRoutes, PicturesAreThoseOfGathering) {
  // Every caster's factor and every product are rounded to half a step of 1/255 in each cell: for n casters
  // over a receiver at most n steps, hardly more than a few in a mean over 16 cells. Lists of tiles and of
  // casters round vertices differently, to a 65,536th of what they span, and a receiver's place comes from 24
  // bits. Casters are lifted along normals kept to 17 degrees.
  for (const char* scene : {"spheres27@light=0.3", "spheres81@light=2", "bars@light=1", "leaves@light=1",
                            "figure@light=0.3", "figure@light=1"}) {
    const Truth& truth = truthOf(scene);
    for (const char* bytes : {"4", "16", "32"}) {
      const std::vector<float> gathered = visibility(scene, cells("gather", bytes));
      const std::vector<float> routed = visibility(scene, route(bytes));
      double groundLargest = 0.0, casterSum = 0.0;
      int casterCount = 0;
      for (std::size_t i = 0; i < gathered.size(); ++i) {
        if (!truth.interior[i]) continue;
        const double difference = std::abs(gathered[i] - routed[i]);
        if (truth.kind[i] == reference::kGroundReceiver) groundLargest = std::max(groundLargest, difference);
        if (truth.kind[i] == reference::kCasterReceiver) casterSum += difference * difference, ++casterCount;
      }
      const double casterRmse = std::sqrt(casterSum / std::max(casterCount, 1));
      std::printf("%-20s %s %-3s differs by %.4f on the ground, rmse %.4f on casters\n", scene, GetParam(),
                  bytes, groundLargest, casterRmse);
      // Gathering decides for a block of tiles which touching casters are taken together, the others for a
      // fragment: with one cell a quarter that shows a step more.
      EXPECT_LE(groundLargest, (bytes == std::string("4") ? 3.5 : 2.5) / 255.0) << scene << ", " << bytes;
      EXPECT_LE(casterRmse, 0.005) << scene << ", " << bytes;
    }
  }
}

TEST_P(CellsRoutes, CastersReceiveAsWellAsTheGround) {
  if (gathers())
    GTEST_SKIP() << "without highp a fragment does not know which side of its own facet it is on";
  for (const std::string& scene : kWedgeScenes) {
    const Truth& truth = truthOf(scene);
    const auto error =
        metrics::errorStatistics(visibility(scene, route()), truth.visibility, judgedOnCasters(truth));
    EXPECT_LE(error.rmse, 0.015) << scene;
    // As gathered.
    EXPECT_LE(error.max, scene == "leaves@light=2" ? 0.17 : 0.06) << scene;
  }
}

TEST_P(CellsRoutes, OnePassATarget) {
  if (gathers()) GTEST_SKIP() << "without highp there are no targets";
  const struct {
    const char* bytes;
    std::uint64_t targets, means, draws;
  } kCosts[] = {{"4", 1, 0, 4}, {"16", 4, 0, 4}, {"32", 8, 1, 8}};
  // Volumes are drawn otherwise where the near plane's corners lie inside them: keep it away from all.
  scene::SceneDescription scene = builtinScene("spheres27@light=1");
  scene.camera->nearDistance = 1e-3;
  renderer().load(scene);
  for (const auto& cost : kCosts) {
    renderer().render(route(cost.bytes));
    const Report& report = renderer().report();
    // Receivers' depths, targets, receivers; eight targets are more than the last pass reads.
    EXPECT_EQ(report.passes.size(), cost.targets + cost.means + 2) << cost.bytes;
    EXPECT_EQ(report.framebufferSwitches, cost.targets + cost.means + 2) << cost.bytes;
    // Of all casters together, those before receivers and those at their heights; 27 spheres and the ground
    // twice.
    EXPECT_EQ(report.draws, 2 * cost.draws + cost.means + 2 * 28) << cost.bytes;
    renderer().render();
    EXPECT_EQ(renderer().report().textureBytesUploaded + renderer().report().bufferBytesUploaded, 0u);
  }
}

TEST_P(CellsRoutes, LightInsideAClosedCasterLightsNothingOutside) {
  scene::SceneDescription scene{.name = "lamp"};
  scene.objects = {boxObject({0, 4, 0}, {1, 1, 1}), groundPlane(20.0)};
  scene.camera = cameraAbove(0.0, 0.0, 4.0);
  scene.lights = {lightAbove({0, 4, 0}, 0.2, 0.2)};
  renderer().load(scene);
  for (const char* bytes : {"4", "16", "32"}) {
    const Image image = renderer().render(route(bytes));
    // The corner shows the ground.
    EXPECT_EQ(image.byte(0), 0) << bytes;
  }
}

TEST_P(CellsRoutes, CasterBehindTheLightCastsNothing) {
  scene::SceneDescription scene{.name = "above"};
  scene.objects = {boxObject({0, 9, 0}, {1, 1, 1}), groundPlane(20.0)};
  scene.camera = cameraAbove(0.0, 0.0, 4.0);
  scene.camera->eyeWorld.y = 6.0;
  scene.lights = {lightAbove({0, 7, 0}, 0.5, 0.5)};
  renderer().load(scene);
  const Image image = renderer().render(route());
  for (std::size_t i = 0; i < image.pixels(); ++i) ASSERT_EQ(image.byte(i), 255);
}

TEST_P(CellsRoutes, EachLightHasItsChannel) {
  scene::SceneDescription scene = builtinScene("figure@light=0.3");
  scene::AreaLight second = scene.lights[0];
  second.centerWorld.x = -second.centerWorld.x;
  scene.lights = {second};
  renderer().load(scene);
  const Image alone = renderer().render(route());
  scene.lights = {builtinScene("figure@light=0.3").lights[0], second};
  renderer().load(scene);
  const Image both = renderer().render(route());
  int differing = 0;
  for (std::size_t i = 0; i < both.pixels(); ++i) differing += both.byte(i, 1) != alone.byte(i, 0);
  EXPECT_LE(differing, 20) << "pixels on outlines";
}

INSTANTIATE_TEST_SUITE_P(Routes, CellsRoutes, testing::Values("scatter", "fetch"));

using CellsRouteFallbacks = EngineTest;

TEST_F(CellsRouteFallbacks, WhatIsMissingIsNoted) {
  SceneRenderer withoutFetch(makeEngine({"framebuffer-fetch"}));
  withoutFetch.load(builtinScene("box@light=1"));
  const Image fetched = withoutFetch.render(cells("fetch"));
  if (!isForcedOff("highp")) {
    EXPECT_TRUE(withoutFetch.report().hasSkip("light 0 route fetch", "by blending"));
  }
  EXPECT_EQ(fetched.rgba, withoutFetch.render(cells("scatter")).rgba);
  SceneRenderer withoutHighp(makeEngine({"highp"}));
  withoutHighp.load(builtinScene("box@light=1"));
  const Image scattered = withoutHighp.render(cells("scatter"));
  EXPECT_TRUE(withoutHighp.report().hasSkip("light 0 route scatter", "gathered"));
  EXPECT_EQ(scattered.rgba, withoutHighp.render(cells("gather")).rgba);
}

}  // namespace
}  // namespace halfshadow::test
