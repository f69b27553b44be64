// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Lights that come, go and change places.
#include <gtest/gtest.h>

#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {

class Lights : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    renderer_ = std::make_unique<SceneRenderer>(makeEngine());
    renderer().load(builtinScene("figure@light=0.3"));
    for (int i = 0; i < 3; ++i) {
      lights_.push_back(builtinScene("figure@light=0.3").lights.front());
      lights_.back().centerWorld.x += 2.0 * i;
    }
    set({0, 1, 2});
    renderer().choose({"hard"});
    renderer().render();
    EXPECT_EQ(renderer().report().lightPasses(), 3u);
  }
  void TearDown() override {
    renderer_.reset();
    EngineTest::TearDown();
  }
  SceneRenderer& renderer() { return *renderer_; }
  void set(const std::vector<std::size_t>& which) {
    std::vector<scene::AreaLight> lights;
    for (const std::size_t i : which) lights.push_back(lights_[i]);
    renderer().setLights(lights);
  }
  std::size_t lightPasses(const std::vector<std::size_t>& which) {
    set(which);
    last_ = renderer().render();
    return renderer().report().lightPasses();
  }
  std::vector<scene::AreaLight> lights_;
  Image last_;

 private:
  std::unique_ptr<SceneRenderer> renderer_;
};

TEST_F(Lights, ThoseThatStayKeepTheirMaps) {
  EXPECT_EQ(lightPasses({1, 2}), 0u);
  const Image kept = last_;
  EXPECT_TRUE(renderer().report().hasSkip("light 1", "unchanged"));
  EXPECT_TRUE(renderer().report().hasSkip("light 2", "unchanged"));
  EXPECT_EQ(lightPasses({2, 1}), 0u) << "in another order";
  EXPECT_EQ(lightPasses({1, 2}), 0u);
  EXPECT_EQ(last_.rgba, kept.rgba);
  EXPECT_EQ(lightPasses({1, 2, 0}), 1u) << "the one that came again";
  EXPECT_EQ(lightPasses({1}), 0u);
}

TEST_F(Lights, OneThatMovesStaysItself) {
  lights_[1].centerWorld.y += 0.5;
  EXPECT_EQ(lightPasses({0, 1, 2}), 1u);
  EXPECT_TRUE(renderer().report().hasSkip("light 0", "unchanged"));
  EXPECT_FALSE(renderer().report().hasSkip("light 1", "unchanged"));
  lights_[2].centerWorld.y += 0.5;
  EXPECT_EQ(lightPasses({1, 2}), 1u) << "one went while another moved";
}

TEST_F(Lights, ReorderedLightsAreDrawnAsThoughTheyWereNew) {
  set({2, 0});
  const Image kept = renderer().render();
  auto fresh = makeEngine();
  SceneRenderer other(std::move(fresh));
  other.load(builtinScene("figure@light=0.3"));
  other.setLights({lights_[2], lights_[0]});
  EXPECT_EQ(other.render(Configuration{"hard"}).rgba, kept.rgba);
}

}  // namespace
}  // namespace halfshadow::test
