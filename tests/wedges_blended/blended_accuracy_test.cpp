// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// wedges-blended against ray-traced truth: 17 configurations of casters and lights.
#include <algorithm>
#include <cstdio>

#include "metrics/metrics.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

const std::vector<std::string> kWedgeScenes = {
    "spheres27@light=0.3", "spheres27@light=1", "spheres27@light=2", "spheres81@light=1", "spheres81@light=2",
    "box@light=0.3",       "box@light=1",       "box@light=2",       "bars@light=1",      "bars@light=2",
    "fence@light=0.3",     "fence@light=1",     "leaves@light=0.3",  "leaves@light=1",    "leaves@light=2",
    "figure@light=0.3",    "figure@light=1"};

Configuration blended(const std::string& centres) {
  return {"wedges-blended", {{"wedges-blended.cog", centres}}};
}

class BlendedAccuracy : public SharedEngineTest {
 protected:
  struct Mean {
    double rmse = 0.0, p99 = 0.0, largest = 0.0;
  };
  static std::vector<float> visibility(const std::string& scene, const Configuration& configuration) {
    renderer().load(builtinScene(scene));
    return renderer().render(configuration).visibility();
  }
  /// Penumbra pixels of the ground that no outline of a caster cuts: there, rasterisers and rays see
  /// different surfaces.
  static std::vector<std::uint8_t> judged(const Truth& truth) {
    std::vector<std::uint8_t> pixels = truth.penumbraOnGround();
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = pixels[i] && truth.interior[i];
    return pixels;
  }
  /// `largest` is over all scenes.
  static Mean meanError(const Configuration& configuration) {
    Mean mean;
    const auto share = 1.0 / static_cast<double>(kWedgeScenes.size());
    for (const std::string& scene : kWedgeScenes) {
      const Truth& truth = truthOf(scene);
      const auto error =
          metrics::errorStatistics(visibility(scene, configuration), truth.visibility, judged(truth));
      EXPECT_EQ(error.nanPixels, 0u) << scene;
      mean.rmse += error.rmse * share;
      mean.p99 += error.p99 * share;
      mean.largest = std::max(mean.largest, error.max);
    }
    std::printf("%-34s rmse %.5f, p99 %.4f, largest %.3f\n", configuration.text().c_str(), mean.rmse,
                mean.p99, mean.largest);
    return mean;
  }
  /// fp16 knows a fragment's place to 11 bits: twice the error is the price of a device without highp.
  static double precision() { return isForcedOff("highp") ? 2.0 : 1.0; }
};

TEST_F(BlendedAccuracy, RectanglesReachTheFiguresOfThePaperDoneExactly) {
  const Mean mean = meanError(blended("off"));
  // Four rectangles with exact sides, stored in 8 bits: .0119 / .047 / .186 on the CPU.
  EXPECT_LE(mean.rmse, 0.0145 * precision());
  EXPECT_LE(mean.p99, 0.055 * precision());
  if (!isForcedOff("highp")) {
    EXPECT_LE(mean.largest, 0.2);
  }
}

TEST_F(BlendedAccuracy, CentresOfGravityTakeAThirdOfTheErrorAway) {
  const Mean mean = meanError(blended("on"));
  // .0083 / .033 on the CPU.
  EXPECT_LE(mean.rmse, 0.0095 * precision());
  EXPECT_LE(mean.p99, 0.038 * precision());
  if (!isForcedOff("highp")) {
    EXPECT_LE(mean.largest, 0.2);
  }
}

TEST_F(BlendedAccuracy, WithoutOverlapTheSharesAreAddedUp) {
  if (isForcedOff("highp")) GTEST_SKIP() << "without highp vertex lists are more exact than wedges";
  for (const char* scene : {"box@light=0.3", "box@light=1"}) {
    const Truth& truth = truthOf(scene);
    const std::vector<float> picture = visibility(scene, blended("on"));
    const auto error = metrics::errorStatistics(picture, truth.visibility, judged(truth));
    // At h = 1 what remains is the silhouette of the light's centre, which every caster of this kind shares.
    EXPECT_LE(error.rmse, (scene == std::string("box@light=0.3") ? 0.004 : 0.022) * precision()) << scene;
    EXPECT_EQ(picture, visibility(scene, {"wedges"})) << scene << ": nothing to blend, so nothing may differ";
  }
}

TEST_F(BlendedAccuracy, BlendingIsLighterThanAddingUp) {
  if (isForcedOff("highp")) GTEST_SKIP() << "without highp vertex lists are more exact than wedges";
  const Truth& truth = truthOf("figure@light=1");
  const std::vector<float> both = visibility("figure@light=1", blended("on"));
  const std::vector<float> added = visibility("figure@light=1", {"wedges"});
  const auto pixels = judged(truth);
  int darker = 0, count = 0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    if (!pixels[i]) continue;
    ++count;
    darker += both[i] < added[i] - 0.012f;
  }
  // Two ways to the same areas: sums of pieces in 8 bits, and lists with 16-bit vertices.
  EXPECT_LE(darker, count / 200);
}

}  // namespace
}  // namespace halfshadow::test
