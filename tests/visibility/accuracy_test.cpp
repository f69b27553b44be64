// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every technique against ray-traced truth: RMSE of visibility over the penumbra pixels of the ground, mean
// of the eleven benchmark scenes. Runs once per rung of the fallback ladder: a fallback that is less accurate
// is a bug.
#include <algorithm>
#include <cstdio>
#include <ostream>

#include "metrics/metrics.hpp"
#include "reference/reference.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

struct Expectation {
  std::string name;
  Configuration configuration;
  double least, most;  ///< of the mean penumbra RMSE
  double mostTaps;     ///< per receiver pixel, mean
};

void PrintTo(const Expectation& expectation, std::ostream* stream) {
  *stream << expectation.configuration.text();
}

const Setting kOneMap{"sub_lights", "1"};

// The bounds below are the project's figures. Error has a lower bound too where the method cannot be better:
// a picture that is too good means that another technique answered.
const Expectation kExpectations[] = {
    // One bit against a ramp: .289 = 1/sqrt(12) if edges lay evenly; less since a hard edge runs
    // mid-penumbra.
    {"hard", {"hard"}, 0.20, 0.29, 1.0},
    // A fixed kernel of 4 texels against penumbrae of 5 to 120: little better than hard. The prototype's .228
    // had maps
    // fitted less tightly, so that 4 texels were wider.
    {"pcf4", {"pcf"}, 0.18, 0.26, 16.0},
    // The published race measured .143 for the best fixed filter per light size; 7 texels are narrower than
    // it.
    {"pcf7", {"pcf", {{"pcf.size", "7"}}}, 0.14, 0.24, 49.0},
    {"pcf_masked4", {"pcf-masked"}, 0.18, 0.26, 2.6},
    // Nine maps where penumbrae are wide: the project's goal for bands.
    {"pcf_quantized_tuned", {"pcf-quantized"}, 0.005, 0.022, 49.0},
    // Eight bands and the single depth layer.
    {"pcf_quantized_whole", {"pcf-quantized", {kOneMap}}, 0.02, 0.065, 49.0},
    // The paper's bins pick the wrong band at corners and inner edges: .212 in emulation, .230 measured.
    {"pcf_quantized_paper", {"pcf-quantized", {{"pcf-quantized.preset", "paper"}}}, 0.19, 0.26, 49.0},
    // One depth layer is the wall at .034; .042 leaves what 7 x 7 taps quantise.
    {"pcss_whole", {"pcss", {kOneMap}}, 0.02, 0.042, 28.0},
    // The same error as pcss for fewer taps: 13.7; looking at regions twice at most, 12.8 and .0354 instead
    // of
    // .0346.
    {"pcss_mip7_whole", {"pcss-mip", {{"pcss-mip.size", "7"}, kOneMap}}, 0.02, 0.042, 14.0},
    // Nine maps where penumbrae are wide, 4 x 4 taps in each: the project's goal.
    {"pcss", {"pcss"}, 0.005, 0.018, 49.0},
    {"pcss_mip7", {"pcss-mip", {{"pcss-mip.size", "7"}}}, 0.005, 0.018, 49.0},
    // 16 hard shadows: steps of 1/16 have an RMSE of .018, and lie unevenly.
    {"hard_of_sixteen", {"hard", {{"sub_lights", "4"}}}, 0.018, 0.06, 16.0},
    // Two moments bound the lit share from above and blur by a fixed kernel.
    {"vsm", {"vsm"}, 0.10, 0.25, 4.0},
    // Two fetches: straight edges exactly, corners by the occupied share of the kernel. The project's goal is
    // .07; .029
    // measured, .033 without highp, where distances have 11 bits.
    {"shadow_width_signed", {"shadow-width"}, 0.01, 0.04, 2.0},
    // Only the inner half of the penumbra exists: .20 to .25 in emulation.
    {"shadow_width_paper", {"shadow-width", {{"shadow-width.preset", "paper"}}}, 0.19, 0.26, 2.0},
    // 64 points of the light: .018 measured; a regular lattice of 64 has errors of up to 1/8 across a
    // straight edge.
    {"sampled64", {"sampled"}, 0.005, 0.025, 1.0},
};

class Accuracy : public SharedEngineTest, public testing::WithParamInterface<Expectation> {};

TEST_P(Accuracy, MeanPenumbraErrorIsTheProjectsFigure) {
  const Expectation& expected = GetParam();
  std::string reason;
  if (!supports(expected.configuration.technique, reason)) {
    ASSERT_TRUE(expected.configuration.technique == "vsm" && isForcedOff("highp")) << reason;
    EXPECT_NE(reason.find("highp"), std::string::npos);
    GTEST_SKIP() << "vsm needs " << reason;
  }
  double rmse = 0.0, taps = 0.0, worst = 0.0;
  std::string numbers, worstScene;
  std::vector<float> worstImage;
  for (const std::string& name : kBenchmarkScenes) {
    const Truth& truth = truthOf(name);
    renderer().load(builtinScene(name));
    const std::vector<float> visibility = renderer().render(expected.configuration).visibility();
    const auto error = metrics::errorStatistics(visibility, truth.visibility, truth.penumbraOnGround());
    EXPECT_EQ(error.nanPixels, 0u);
    const Image count = renderer().render(Output::taps);
    double sceneTaps = 0.0, receivers = 0.0;
    for (std::size_t i = 0; i < count.pixels(); ++i) {
      if (truth.kind[i] == reference::kNoReceiver) continue;
      sceneTaps += count.byte(i, 0) + 256.0 * count.byte(i, 1);
      receivers += 1.0;
    }
    rmse += error.rmse;
    taps += sceneTaps / receivers;
    char line[160];
    std::snprintf(line, sizeof line, "%s rmse %.4f p99 %.3f bias %+.4f taps %.2f\n", name.c_str(), error.rmse,
                  error.p99, error.bias, sceneTaps / receivers);
    numbers += line;
    if (error.rmse > worst) worst = error.rmse, worstScene = name, worstImage = visibility;
  }
  const auto scenes = static_cast<double>(kBenchmarkScenes.size());
  RecordProperty("penumbra_rmse", std::to_string(rmse / scenes));
  RecordProperty("taps_per_pixel", std::to_string(taps / scenes));
  std::printf("%-20s mean penumbra rmse %.4f, taps %.2f\n", expected.name.c_str(), rmse / scenes,
              taps / scenes);
  EXPECT_LE(rmse / scenes, expected.most);
  EXPECT_GE(rmse / scenes, expected.least) << "too good for this method: does another one answer?";
  // Without highp a fragment knows its place in the map to a texel only: masks must reach farther to stay
  // provable, and leave more pixels to the filter.
  const double slack = isForcedOff("highp") && expected.mostTaps < 16.0 ? 1.25 : 1.0;
  EXPECT_LE(taps / scenes, expected.mostTaps * slack + 1e-9);
  if (HasFailure()) {
    std::printf("%s%s\n", numbers.c_str(),
                saveComparison(expected.name + "_" + worstScene, truthOf(worstScene), worstImage).c_str());
  }
}

using ExactAccuracy = SharedEngineTest;

INSTANTIATE_TEST_SUITE_P(Techniques, Accuracy, testing::ValuesIn(kExpectations),
                         [](const auto& tested) { return tested.param.name; });

// The umbra and the lit ground are where one number is right: techniques that know both exactly must say so.
TEST_F(ExactAccuracy, LitAndUmbraGroundAreExactAwayFromPenumbrae) {
  for (const char* technique : {"pcf-quantized", "pcss", "pcss-mip", "sampled"}) {
    for (const std::string& name : {std::string("figure@light=0.3"), std::string("box@light=0.3")}) {
      const Truth& truth = truthOf(name);
      renderer().load(builtinScene(name));
      const Image image = renderer().render(Configuration{technique});
      int wrong = 0, judged = 0;
      // Four pixels are about two texels of the map, the reach of its own rounding.
      constexpr int kMargin = 4;
      for (int y = kMargin; y < kHeight - kMargin; ++y) {
        for (int x = kMargin; x < kWidth - kMargin; ++x) {
          const auto center = static_cast<std::size_t>(y * kWidth + x);
          bool uniform = true;
          for (int dy = -kMargin; dy <= kMargin; ++dy) {
            for (int dx = -kMargin; dx <= kMargin; ++dx) {
              const auto near = static_cast<std::size_t>((y + dy) * kWidth + x + dx);
              uniform = uniform && truth.kind[near] == reference::kGroundReceiver &&
                        truth.visibility[near] == truth.visibility[center];
            }
          }
          if (!uniform || (truth.visibility[center] != 0.0f && truth.visibility[center] != 1.0f)) continue;
          ++judged;
          wrong += image.byte(center) != (truth.visibility[center] == 0.0f ? 0 : 255);
        }
      }
      EXPECT_GE(judged, 1000) << name;
      // The blocker search may reach farther than the penumbra: at most 1 in 1000 pixels, at the rim.
      EXPECT_LE(wrong, judged / 1000) << technique << " on " << name << " of " << judged;
      if (wrong > judged / 1000)
        saveComparison(std::string(technique) + "_exact_" + name, truth, image.visibility());
    }
  }
}

}  // namespace
}  // namespace halfshadow::test
