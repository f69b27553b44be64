// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// An instrument that never objects measures nothing: pictures broken in known ways get the verdict they
// deserve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stress/judge.hpp"

namespace halfshadow::stress {
namespace {
constexpr int kWidth = 60, kHeight = 40;
constexpr std::size_t kPixels = static_cast<std::size_t>(kWidth) * kHeight;

/// Left dark, right lit, between them a penumbra `wide` pixels wide.
std::vector<float> ramp(double wide, double middle = 30.0) {
  std::vector<float> picture(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) {
    const double x = static_cast<double>(i % kWidth) + 0.5 - middle;
    picture[i] = static_cast<float>(std::clamp(x / wide + 0.5, 0.0, 1.0));
  }
  return picture;
}

Yardstick yardstick(double wide = 12.0) {
  Yardstick result;
  result.truth.width = kWidth, result.truth.height = kHeight;
  result.truth.visibility = ramp(wide);
  result.hard = ramp(1e-9);
  result.judged.assign(kPixels, 0);
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth; ++x) result.judged[static_cast<std::size_t>(y * kWidth + x)] = 1;
  }
  return result;
}

Judgement verdictOn(Rule rule, const std::vector<float>& picture, const std::vector<float>& inBaseScene,
                    const std::string& fellBack = "") {
  const Yardstick truth = yardstick();
  const Errors base = errorsOf(inBaseScene, truth);
  return judged(rule, errorsOf(picture, truth), &base, errorsOf(truth.hard, truth), 0.0, fellBack);
}

TEST(StressJudge, TheTruthIsOkAndSoIsTheBaseScenesError) {
  for (const Rule rule : {Rule::same, Rule::own}) {
    EXPECT_EQ(verdictOn(rule, ramp(12), ramp(12)).verdict, Verdict::ok);
    EXPECT_EQ(verdictOn(rule, ramp(16), ramp(16)).verdict, Verdict::ok);
    EXPECT_EQ(verdictOn(rule, ramp(1e-9), ramp(1e-9)).verdict, Verdict::ok) << "hard shadows stay hard";
  }
}

TEST(StressJudge, MoreErrorThanInTheBaseSceneIsWorse) {
  const Judgement judgement = verdictOn(Rule::own, ramp(18), ramp(13));
  EXPECT_EQ(judgement.verdict, Verdict::worse);
  EXPECT_NE(judgement.reason.find("penumbra RMSE"), std::string::npos) << judgement.reason;
  EXPECT_EQ(verdictOn(Rule::own, ramp(18), ramp(13), "light 0: by taps").verdict, Verdict::fellBack);
  // The same scene gives the same picture: twice the error is another.
  EXPECT_EQ(verdictOn(Rule::same, ramp(18), ramp(13)).verdict, Verdict::wrong);
}

TEST(StressJudge, LostShadowsLeaksAndSpotsAreWrong) {
  const std::vector<float> good = ramp(12), lit(kPixels, 1.0f), dark(kPixels, 0.0f);
  std::vector<float> leaking = good, spotted = good;
  for (std::size_t i = 0; i < kPixels; ++i) {
    if (i % kWidth == 8 || i % kWidth == 9) leaking[i] = 0.4f;  // a streak in the umbra
    if (i % 61 == 0) spotted[i] = 1.0f - spotted[i];            // one pixel of 61
  }
  for (const Rule rule : {Rule::base, Rule::same, Rule::own}) {
    for (const std::vector<float>& picture : {lit, dark, leaking, spotted}) {
      const Judgement judgement = verdictOn(rule, picture, good, "even with a reason");
      EXPECT_EQ(judgement.verdict, Verdict::wrong) << judgement.reason;
    }
  }
}

TEST(StressJudge, HardShadowsAreNotWrongWhereSoftOnesAreAsked) {
  EXPECT_EQ(verdictOn(Rule::own, ramp(1e-9), ramp(12)).verdict, Verdict::worse);
  EXPECT_EQ(verdictOn(Rule::own, ramp(1e-9), ramp(12), "light 0: hard").verdict, Verdict::fellBack);
  // Half a pixel beside is the rasteriser's; six pixels beside are another shadow.
  EXPECT_EQ(verdictOn(Rule::own, ramp(1e-9, 31), ramp(1e-9)).verdict, Verdict::ok);
  EXPECT_EQ(verdictOn(Rule::own, ramp(1e-9, 40), ramp(1e-9)).verdict, Verdict::wrong);
}

TEST(StressJudge, NoiseOfTheTruthIsNobodysError) {
  const Yardstick truth = yardstick();
  Errors base = errorsOf(ramp(12), truth), errors = base;
  base.penumbraRmse = errors.penumbraRmse = 0.05;
  const Errors hard = errorsOf(truth.hard, truth);
  errors.penumbraRmse = 0.06;
  EXPECT_EQ(judged(Rule::own, errors, &base, hard, 0.0, "").verdict, Verdict::ok);
  EXPECT_EQ(judged(Rule::own, errors, &base, hard, 0.05, "").verdict, Verdict::ok);
  errors.penumbraRmse = 0.075;
  EXPECT_EQ(judged(Rule::own, errors, &base, hard, 0.0, "").verdict, Verdict::ok) << "1.3 x .05 + .012";
  EXPECT_EQ(judged(Rule::own, errors, &base, hard, 0.05, "").verdict, Verdict::worse)
      << "all of the base's error was noise";
}

TEST(StressJudge, ClosedForms) {
  Yardstick truth = yardstick();
  std::ranges::fill(truth.truth.visibility, 0.0f);
  truth.hard = truth.truth.visibility;
  EXPECT_EQ(judgedDark(errorsOf(truth.truth.visibility, truth)).verdict, Verdict::ok);
  EXPECT_EQ(judgedDark(errorsOf(ramp(12), truth)).verdict, Verdict::wrong);
  std::ranges::fill(truth.truth.visibility, 1.0f);
  truth.hard = truth.truth.visibility;
  EXPECT_EQ(judgedLit(errorsOf(truth.truth.visibility, truth)).verdict, Verdict::ok);
  EXPECT_EQ(judgedLit(errorsOf(ramp(12), truth)).verdict, Verdict::wrong);
}

TEST(StressJudge, AChangedPictureIsWorseThoughItsErrorIsTheSame) {
  const Yardstick truth = yardstick();
  const std::vector<float> left = ramp(12, 28), right = ramp(12, 32);
  EXPECT_NEAR(errorsOf(left, truth).penumbraRmse, errorsOf(right, truth).penumbraRmse, 0.01);
  EXPECT_EQ(changeBetween(left, left, truth), 0.0);
  EXPECT_NEAR(changeBetween(left, right, truth), 4.0 / 12.0, 1e-3);
  EXPECT_EQ(alsoUnchanged({}, 0.05).verdict, Verdict::ok);
  EXPECT_EQ(alsoUnchanged({}, 4.0 / 12.0).verdict, Verdict::worse);
}

TEST(StressJudge, JumpsAreCountedBeyondTheTruths) {
  std::vector<Yardstick> truths;
  std::vector<std::vector<float>> following, lagging;
  for (int frame = 0; frame < 4; ++frame) {
    truths.push_back(yardstick());
    truths.back().truth.visibility = ramp(4, 20.0 + 2.0 * frame);
    following.push_back(truths.back().truth.visibility);
    lagging.push_back(ramp(4, frame < 2 ? 20.0 : 26.0));
  }
  EXPECT_EQ(jumpBeyondTruth(following, truths), 0.0);
  EXPECT_GT(jumpBeyondTruth(lagging, truths), 0.3);
  EXPECT_EQ(judgedSteady(0.05).verdict, Verdict::ok);
  EXPECT_EQ(judgedSteady(0.2).verdict, Verdict::worse);
}

}  // namespace
}  // namespace halfshadow::stress
