// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Maps follow what moves: a part of them is drawn again, and nobody can see that.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "engine_fixture.hpp"
#include "moving_boxes.hpp"

namespace halfshadow::test {
namespace {

/// An engine that draws the boxes as they are, frame after frame.
class Stage {
 public:
  Stage(const char* rule, double halfLight, const std::vector<std::string>& forcedOff = {})
      : engine_(makeEngine(forcedOff)), follower_(*engine_) {
    set("map_updates", rule);
    set("map_size", "128");
    desc_.camera = cameraOverBoxes();
    desc_.target.width = kWidth;
    desc_.target.height = kHeight;
    desc_.output = Output::visibility;
    const LightDesc light = lightOverBoxes(halfLight);
    EXPECT_TRUE(engine_->setLights(&light, 1).ok());
  }
  void set(const char* key, const char* value) {
    const Outcome outcome = engine_->set(key, value);
    EXPECT_TRUE(outcome.ok()) << outcome.message;
  }
  bool choose(const Configuration& configuration) {
    if (!engine_->setTechnique(configuration.technique.c_str()).ok()) return false;
    for (const Setting& setting : configuration.settings) set(setting.key.c_str(), setting.value.c_str());
    return true;
  }
  std::vector<std::uint8_t> draw(const MovingBoxes& boxes) {
    follower_.follow(boxes);
    const Outcome outcome = engine_->render(desc_);
    EXPECT_TRUE(outcome.ok()) << outcome.message;
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(4 * desc_.target.width * desc_.target.height));
    if (desc_.output != Output::lightsOnly) {
      EXPECT_TRUE(engine_->readOutput(rgba.data(), rgba.size()).ok());
    }
    return rgba;
  }
  Engine& engine() { return *engine_; }
  RenderDesc& desc() { return desc_; }
  std::uint64_t drawn() { return engine_->report().castersDrawn; }
  std::uint64_t kept() { return engine_->report().castersKept; }
  std::uint64_t drawsInto(std::string_view pass) {
    const FrameReport report = engine_->report();
    for (std::size_t i = 0; i < report.passCount; ++i) {
      if (pass == report.passes[i].name) return report.passes[i].draws;
    }
    return 0;
  }

 private:
  std::unique_ptr<Engine> engine_;
  MovingBoxes::Follower follower_;
  RenderDesc desc_;
};

const std::vector<Configuration>& mapTechniques() {
  static const std::vector<Configuration> techniques{
      {"hard"},
      {"pcf"},
      {"pcf-quantized"},
      {"pcf-quantized", {{"pcf-quantized.preset", "paper"}}},
      {"pcf-quantized", {{"pcf-quantized.preset", "tuned"}}},
      {"pcss"},
      {"pcss-mip"},
      {"pcss-mip", {{"sub_lights", "3"}}},
      {"pcss-mip", {{"sub_lights", "auto"}}},
      {"vsm"},
      {"shadow-width"},
      {"shadow-width", {{"shadow-width.preset", "paper"}, {"shadow-width.faces", "back"}}},
      {"shadow-width", {{"shadow-width.preset", "signed"}, {"sub_lights", "2"}}},
      {"occlusion-textures", {{"sub_lights", "auto"}}},
      {"occlusion-textures", {{"sub_lights", "1"}, {"occlusion-textures.filter", "mipmap"}}},
      {"occlusion-textures", {{"occlusion-textures.preset", "paper"}}},
      {"occlusion-textures", {{"occlusion-textures.preset", "tuned"}, {"occlusion-textures.filter", "sat"}}}};
  return techniques;
}

class MapUpdates : public EngineTest {
 protected:
  /// Random steps: after each, the picture is that of an engine that draws its maps whole, and after the last
  /// that of one which never saw another frame. Adds the casters that maps kept.
  void followSteps(Stage& updating, Stage& whole, std::uint32_t seed, std::uint64_t& kept) {
    constexpr int kSteps = 8;
    MovingBoxes boxes(seed);
    boxes.fillAtRandom(40);
    for (int step = 0; step < kSteps; ++step) {
      if (step > 0) boxes.step();
      ASSERT_EQ(updating.draw(boxes), whole.draw(boxes)) << "step " << step << " of scene " << seed;
      EXPECT_EQ(whole.kept(), 0u);
      kept += updating.kept();
    }
    EXPECT_TRUE(whole.engine().trim(Trim::everything).ok());
    EXPECT_EQ(updating.draw(boxes), whole.draw(boxes)) << "after all steps of scene " << seed;
  }
  void followEverywhere(const std::vector<std::string>& forcedOff,
                        const std::vector<Configuration>& configurations) {
    Stage updating("always", 0.5, forcedOff), whole("never", 0.5, forcedOff);
    std::uint32_t seed = 0;
    for (const Configuration& configuration : configurations) {
      SCOPED_TRACE(configuration.text());
      ++seed;
      if (!updating.choose(configuration) || !whole.choose(configuration)) continue;
      std::uint64_t kept = 0;
      followSteps(updating, whole, seed, kept);
      EXPECT_GT(kept, 0u) << "no map was updated";
    }
  }
};

TEST_F(MapUpdates, LookLikeMapsDrawnAnew) {
  followEverywhere({}, mapTechniques());
}

TEST_F(MapUpdates, LookLikeMapsDrawnAnewOfPackedDepth) {
  followEverywhere({"depth-texture"}, mapTechniques());
}

TEST_F(MapUpdates, LookLikeMapsDrawnAnewWithoutHighPrecision) {
  followEverywhere({"highp"}, {{"hard"}, {"pcss-mip", {{"sub_lights", "2"}}}, {"occlusion-textures"}});
}

TEST_F(MapUpdates, DrawWhatMovedAndWhatLiesBesideIt) {
  constexpr int kPerSide = 12;
  MovingBoxes boxes(1);
  boxes.fillGrid(kPerSide);
  Stage stage("always", 0.05);
  ASSERT_TRUE(stage.choose({"hard"}));
  const std::size_t middle = kPerSide * kPerSide / 2 + kPerSide / 2;
  for (int frame = 0; frame < 4; ++frame) {
    if (frame > 0) boxes.move(middle, {0.1, 0.0, 0.05});
    stage.draw(boxes);
    SCOPED_TRACE("frame " + std::to_string(frame));
    EXPECT_EQ(stage.drawn() + stage.kept(), boxes.count());
    EXPECT_EQ(stage.drawsInto("light 0 depth"), stage.drawn());
    if (frame == 0) {
      EXPECT_EQ(stage.kept(), 0u);
      continue;
    }
    // It and those around it at most: they stand a box and a half apart.
    EXPECT_LE(stage.drawn(), 9u);
    EXPECT_GE(stage.drawn(), 1u);
  }
  // One that is gone is not drawn, nor is anything that it did not touch.
  boxes.remove(middle);
  stage.draw(boxes);
  EXPECT_LE(stage.drawn(), 8u);
}

TEST_F(MapUpdates, OfEachSubLightAreParts) {
  MovingBoxes boxes(1);
  boxes.fillGrid(12);
  Stage stage("always", 0.4);
  ASSERT_TRUE(stage.choose({"pcss-mip", {{"map_size", "512"}, {"sub_lights", "3"}}}));
  stage.draw(boxes);
  EXPECT_EQ(stage.drawn(), 9 * boxes.count());
  boxes.move(70, {0.05, 0.0, 0.05});
  stage.draw(boxes);
  EXPECT_GE(stage.drawn(), 9u);
  EXPECT_LE(stage.drawn(), 9u * 9u);
  EXPECT_EQ(stage.drawn() + stage.kept(), 9 * boxes.count());
}

TEST_F(MapUpdates, AreMadeWhereTheySaveMoreThanTheyLoad) {
  MovingBoxes few(1), many(1);
  few.fillGrid(5), many.fillGrid(12);
  for (const bool worth : {false, true}) {
    SCOPED_TRACE(worth);
    MovingBoxes& boxes = worth ? many : few;
    Stage stage("auto", 0.05);
    // Loading 1024 x 1024 texels takes as long as 64 draws.
    ASSERT_TRUE(stage.choose({"hard", {{"map_size", "1024"}}}));
    stage.draw(boxes);
    boxes.move(12, {0.1, 0.0, 0.0});
    stage.draw(boxes);
    EXPECT_EQ(stage.kept() > 0, worth);
  }
}

TEST_F(MapUpdates, OfManyMoversAreNone) {
  MovingBoxes boxes(1);
  boxes.fillGrid(12);
  Stage stage("always", 0.05);
  ASSERT_TRUE(stage.choose({"hard"}));
  stage.draw(boxes);
  for (std::size_t i = 0; i < boxes.count(); ++i) boxes.move(i, {0.01, 0.0, 0.0});
  stage.draw(boxes);
  EXPECT_EQ(stage.kept(), 0u);
}

/// Whatever happens between two frames, a map is updated only from what it holds.
TEST_F(MapUpdates, StartFromNothingWhenMapsAreForgotten) {
  struct Between {
    const char* what;
    void (*happens)(Stage&);
    bool keeps;  ///< maps
  };
  const Between events[] = {
      {"nothing", [](Stage&) {}, true},
      {"trim", [](Stage& s) { EXPECT_TRUE(s.engine().trim(Trim::everything).ok()); }, false},
      {"a lost context",
       [](Stage& s) {
         s.engine().contextLost();
         EXPECT_TRUE(s.engine().contextRestored().ok());
       },
       false},
      {"trim of what is unused", [](Stage& s) { EXPECT_TRUE(s.engine().trim(Trim::unused).ok()); }, true},
      {"another technique", [](Stage& s) { EXPECT_TRUE(s.choose({"pcss"})); }, false},
      {"another size of maps", [](Stage& s) { s.set("map_size", "64"); }, false},
      {"another size of the picture", [](Stage& s) { s.desc().target.width /= 2; }, true},
      {"a light elsewhere",
       [](Stage& s) {
         LightDesc light = lightOverBoxes(0.05);
         light.center[0] += 0.1;
         EXPECT_TRUE(s.engine().setLights(&light, 1).ok());
       },
       false},
      {"a frame without shadows",
       [](Stage& s) {
         EXPECT_TRUE(s.choose({"none"}));
         EXPECT_TRUE(s.engine().render(s.desc()).ok());
         EXPECT_TRUE(s.choose({"pcf"}));
       },
       false},
  };
  for (const Between& event : events) {
    SCOPED_TRACE(event.what);
    MovingBoxes boxes(3);
    boxes.fillGrid(9);
    Stage updating("always", 0.05), whole("never", 0.05);
    for (Stage* stage : {&updating, &whole}) {
      ASSERT_TRUE(stage->choose({"pcf"}));
      stage->draw(boxes);
    }
    boxes.move(40, {0.1, 0.0, 0.0});
    event.happens(updating), event.happens(whole);
    EXPECT_EQ(updating.draw(boxes), whole.draw(boxes));
    EXPECT_EQ(updating.kept() > 0, event.keeps);
    boxes.move(41, {0.1, 0.0, 0.1});
    EXPECT_EQ(updating.draw(boxes), whole.draw(boxes));
    EXPECT_GT(updating.kept(), 0u);
  }
}

TEST_F(MapUpdates, OfLightsAloneCostWhatMoved) {
  std::uint64_t draws[2] = {};
  for (const bool many : {false, true}) {
    MovingBoxes boxes(1);
    boxes.fillGrid(many ? 30 : 6);
    Stage stage("always", 0.05);
    ASSERT_TRUE(stage.choose({"pcss-mip", {{"map_size", "512"}}}));
    stage.desc().output = Output::lightsOnly;
    stage.draw(boxes);
    boxes.move(many ? 435 : 21, {0.02, 0.0, 0.02});
    stage.draw(boxes);
    draws[many] = stage.engine().report().draws;
  }
  // As many neighbours, as many passes over the map.
  EXPECT_LE(draws[1], draws[0] + 8);
}

}  // namespace
}  // namespace halfshadow::test
