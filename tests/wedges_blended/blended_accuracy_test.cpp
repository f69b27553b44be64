// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// wedges-blended against ray-traced truth: 17 configurations of casters and lights.

#include "metrics/metrics.hpp"
#include "reference/reference.hpp"
#include "wedge_accuracy.hpp"

namespace halfshadow::test {
namespace {

Configuration blended(const std::string& centres) {
  return {"wedges-blended", {{"wedges-blended.cog", centres}}};
}

using BlendedAccuracy = WedgeAccuracyTest;

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
    const std::vector<float> added = visibility(scene, {"wedges"});
    int differing = 0;
    for (std::size_t k = 0; k < picture.size(); ++k)
      differing += truth.kind[k] == reference::kGroundReceiver && picture[k] != added[k];
    EXPECT_EQ(differing, 0) << scene << ": nothing to blend, so nothing may differ";
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
