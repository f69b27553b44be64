// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The truth that grows in the background is the reference's, and of what is asked for now.
#include <gtest/gtest.h>

#include <chrono>

#include "metrics/metrics.hpp"
#include "reference/reference.hpp"
#include "viewer/error_map.hpp"
#include "viewer/truth_worker.hpp"

namespace halfshadow::viewer {
namespace {

View viewOf(const std::string& source) {
  View view;
  view.source = source;
  EXPECT_TRUE(openScene(view, Keep::nothing).ok());
  view.width = 80, view.height = 60;
  return view;
}

/// False when it takes longer than any machine should.
bool waitFor(const TruthWorker& worker) {
  using namespace std::chrono_literals;
  for (const auto end = std::chrono::steady_clock::now() + 120s; std::chrono::steady_clock::now() < end;) {
    if (worker.state().done) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

TEST(TruthWorker, AgreesWithTheReference) {
  const View view = viewOf("builtin:box");
  std::atomic<int> news{0};
  TruthWorker worker(256, [&news] { ++news; });
  worker.ask(view);
  ASSERT_TRUE(waitFor(worker));
  const auto image = worker.image();
  ASSERT_TRUE(image);
  EXPECT_GE(image->samples, 256);
  EXPECT_GE(news.load(), 2) << "it tells of each step";
  const auto receivers =
      reference::traceReceivers(*view.scene, view.camera, view.lights.front(), view.width, view.height);
  ASSERT_TRUE(receivers.ok());
  const auto truth =
      reference::traceVisibility(*view.scene, view.lights.front(), *receivers, {.samples = 4096, .seed = 77});
  ASSERT_TRUE(truth.ok());
  const auto error = metrics::errorStatistics(image->visibility, *truth, receivers->kind);
  EXPECT_GT(error.pixels, 1000u);
  // Strata have less noise than independent samples.
  EXPECT_LT(error.rmse, image->noiseAtMost + 0.001);
  EXPECT_LT(image->noiseAtMost, 0.04);
  EXPECT_GT(error.rmse, 0.0) << "another seed";
}

TEST(TruthWorker, AnswersTheLastQuestionOnly) {
  const View first = viewOf("builtin:figure");
  View second = first;
  second.camera.eyeWorld += glm::dvec3(1, 0.5, 0);
  TruthWorker worker(64, [] {});
  worker.ask(first);
  worker.ask(second);
  EXPECT_FALSE(worker.image()) << "what there was is thrown away";
  ASSERT_TRUE(waitFor(worker));
  TruthWorker alone(64, [] {});
  alone.ask(second);
  ASSERT_TRUE(waitFor(alone));
  ASSERT_TRUE(worker.image() && alone.image());
  EXPECT_EQ(worker.image()->visibility, alone.image()->visibility);
}

TEST(TruthWorker, TheSameQuestionGoesOn) {
  const View view = viewOf("builtin:box");
  TruthWorker worker(16, [] {});
  worker.ask(view);
  ASSERT_TRUE(waitFor(worker));
  const auto image = worker.image();
  View alike = view;
  alike.technique = "pcf";
  worker.ask(alike);
  EXPECT_EQ(worker.image(), image) << "a technique does not change the truth";
  worker.forget();
  EXPECT_FALSE(worker.image());
  EXPECT_TRUE(worker.state().done);
}

TEST(TruthWorker, EndsInTheMiddleOfItsWork) {
  View view = viewOf("builtin:figure");
  view.width = 640, view.height = 480;
  const auto begin = std::chrono::steady_clock::now();
  {
    TruthWorker worker(1 << 20, [] {});
    worker.ask(view);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(ErrorMap, CountsReceiversOnly) {
  TruthImage truth{.width = 2, .height = 1, .samples = 1, .visibility = {0.5f, 1.0f}, .kind = {1, 0}};
  const ErrorMap map = errorMap({0.7f, 0.0f}, truth, 0.1);
  EXPECT_EQ(map.statistics.pixels, 1u);
  EXPECT_NEAR(map.statistics.rmse, 0.2, 1e-6);
  ASSERT_EQ(map.rgba.size(), 8u);
  EXPECT_GT(map.rgba[0], map.rgba[2]) << "too bright is red";
}

}  // namespace
}  // namespace halfshadow::viewer
