// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Drivers that leave out draws in silence: whatever program it hits, a frame has no hole and nothing stale,
// says why it is another one than was asked for, and no dropped program is drawn with again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analytic_scenes.hpp"
#include "engine_fixture.hpp"
#include "program_layer.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

constexpr const char* kScene = "bars";
constexpr const char* kDraws = "draws nothing on this device";

class DroppedPrograms : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (!HasFatalFailure()) layer_ = std::make_unique<ProgramLayer>();
  }
  void TearDown() override {
    renderer_.reset();
    layer_.reset();
    EngineTest::TearDown();
  }
  ProgramLayer& layer() { return *layer_; }
  /// A new engine under this rule.
  SceneRenderer& start(DropRule rule, const char* proofs = nullptr) {
    renderer_.reset();
    layer_->drop(std::move(rule));
    renderer_ = std::make_unique<SceneRenderer>(layer_->makeEngine({.programProofs = proofs}));
    renderer_->load(builtinScene(kScene));
    renderer_->desc().target.width = 48;
    renderer_->desc().target.height = 36;
    // Like nothing that is lit or in shadow.
    const float background[4] = {1, 0, 1, 1};
    std::copy_n(background, 4, renderer_->desc().clearColor);
    (void)layer_->takeDrawn();
    return *renderer_;
  }
  std::vector<std::string> techniques() { return techniquesBut(start({}).engine(), {}); }
  /// Fragment shaders that the frame of a technique draws with.
  std::set<std::string> filesOf(const std::string& technique) {
    SceneRenderer& renderer = start({});
    renderer.render(Configuration{technique}, Output::shaded);
    std::set<std::string> files;
    for (const DrawnProgram& program : layer_->takeDrawn()) {
      if (!program.file().empty()) files.insert(program.file());
    }
    return files;
  }
  static std::set<std::size_t> background(const Image& image) {
    std::set<std::size_t> pixels;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      if (image.byte(i, 0) == 255 && image.byte(i, 1) == 0 && image.byte(i, 2) == 255) pixels.insert(i);
    }
    return pixels;
  }
  bool givesReason(const std::string& part) {
    return std::ranges::any_of(renderer_->report().skips,
                               [&](const Skip& skip) { return skip.why.find(part) != std::string::npos; });
  }
  /// Nothing is submitted in vain once it is known.
  void expectNothingDropped() {
    const std::uint64_t before = layer_->droppedDraws();
    renderer_->desc().camera.eye[0] += 0.01;
    renderer_->render(Output::shaded);
    EXPECT_EQ(layer_->droppedDraws(), before);
  }

 private:
  std::unique_ptr<ProgramLayer> layer_;
  std::unique_ptr<SceneRenderer> renderer_;
};

DropRule ofFile(std::string file) {
  return [file = std::move(file)](const DrawnProgram& program) { return program.file() == file; };
}
DropRule allBut(std::set<std::string> files) {
  return [files = std::move(files)](const DrawnProgram& program) {
    return !program.file().empty() && !files.contains(program.file());
  };
}

TEST_F(DroppedPrograms, LeaveNoHoleAndAReasonInEveryTechnique) {
  int cases = 0;
  for (const std::string& technique : techniques()) {
    const std::set<std::string> files = filesOf(technique);
    const auto receivers = background(start({}).render(Configuration{technique}, Output::shaded));
    for (const std::string& file : files) {
      if (technique == "none") continue;
      SCOPED_TRACE(technique + " without " + file);
      SceneRenderer& renderer = start(ofFile(file));
      const Image image = renderer.render(Configuration{technique}, Output::shaded);
      EXPECT_EQ(background(image), receivers) << "a hole, or something drawn beside the receivers";
      EXPECT_TRUE(givesReason(kDraws));
      EXPECT_TRUE(givesReason(file)) << "the program is named";
      expectNothingDropped();
      ++cases;
    }
  }
  EXPECT_GT(cases, 40);
}

// What an image holds from before must not be read where the pass that fills it is not drawn.
TEST_F(DroppedPrograms, LeaveNothingStale) {
  for (const std::string technique : {"pcf-masked", "pcss-mip", "vsm", "shadow-width", "wedges-blended"}) {
    SCOPED_TRACE(technique);
    for (const std::string& file : filesOf(technique)) {
      SCOPED_TRACE(file);
      auto lights = builtinScene(kScene).lights;
      lights[0].centerWorld.x += 1.0;
      SceneRenderer& fresh = start(ofFile(file));
      fresh.setLights(lights);
      const Image expected = fresh.render(Configuration{technique}, Output::shaded);
      SceneRenderer& renderer = start(ofFile(file));
      const Image first = renderer.render(Configuration{technique}, Output::shaded);
      renderer.setLights(lights);
      EXPECT_EQ(renderer.render(Output::shaded).rgba, expected.rgba);
      EXPECT_NE(first.rgba, expected.rgba) << "the light moved for nothing";
    }
  }
}

TEST_F(DroppedPrograms, LeadToTheLastResortStepByStep) {
  const Image unshadowed = start({}).render(Configuration{"none"}, Output::shaded);
  for (const std::string& technique : techniques()) {
    SCOPED_TRACE(technique);
    SceneRenderer& renderer = start(allBut({"receiver/none.frag", "receiver/shade_lights.frag"}));
    EXPECT_EQ(renderer.render(Configuration{technique}, Output::shaded).rgba, unshadowed.rgba);
    if (technique != "none") EXPECT_TRUE(givesReason("without shadows"));
    expectNothingDropped();
  }
}

TEST_F(DroppedPrograms, WithoutAnyResortAreAnError) {
  SceneRenderer& renderer = start(allBut({}));
  renderer.choose({"pcf"});
  const Outcome outcome = renderer.engine().render(renderer.desc());
  EXPECT_EQ(outcome.code, ErrorCode::capabilityMissing);
  EXPECT_NE(std::string(outcome.message).find("links without an error but draws nothing"), std::string::npos)
      << outcome.message;
}

// As where 256 instructions are all there are: one map, tap by tap, and yet a penumbra as wide as the light
// makes it.
TEST_F(DroppedPrograms, LeaveFiltersThatFollowThePenumbra) {
  const char* const scene = "figure@light=1";
  const Truth& truth = truthOf(scene);
  const std::vector<std::uint8_t> penumbra = truth.penumbraOnGround();
  const auto rmse = [&](DropRule rule, const std::string& technique) {
    SceneRenderer& renderer = start(std::move(rule));
    renderer.load(builtinScene(scene));
    const std::vector<float> seen = renderer.render(Configuration{technique}).visibility();
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!penumbra[i]) continue;
      sum += (seen[i] - truth.visibility[i]) * (seen[i] - truth.visibility[i]);
      count += 1.0;
    }
    return std::sqrt(sum / count);
  };
  const double hard = rmse({}, "hard");
  const auto tooLong = [](const DrawnProgram& program) {
    const bool followsPenumbra =
        program.file().starts_with("map/pcss") || program.file() == "map/pcf_quantized.frag";
    return followsPenumbra && (program.defines().find("SHORT") == std::string::npos ||
                               program.defines().find("SUB_LIGHTS") != std::string::npos);
  };
  for (const char* technique : {"pcss", "pcss-mip", "pcf-quantized"}) {
    // Measured .06 where hard shadows have .2 to .3.
    EXPECT_LT(rmse(tooLong, technique), 0.4 * hard) << technique;
    EXPECT_TRUE(givesReason("short programs over one map")) << technique;
  }
}

// Casters with holes are drawn by a variant of their own.
TEST_F(DroppedPrograms, ThatCutHolesAreFound) {
  for (const char* technique : {"hard", "occlusion-textures", "shadow-volume"}) {
    const auto render = [&](DropRule rule) {
      SceneRenderer& renderer = start(std::move(rule));
      const float positions[] = {-1, 2, -1, 1, 2, -1, 1, 2, 1, -1, 2, 1};
      const float texcoords[] = {0, 0, 1, 0, 1, 1, 0, 1};
      const std::uint32_t indices[] = {0, 2, 1, 0, 3, 2};
      const std::uint8_t pixels[] = {90, 90, 90, 255, 90, 90, 90, 0};
      ObjectDesc card{.mesh = {.positions = positions,
                               .vertexCount = 4,
                               .indices = indices,
                               .indexCount = 6,
                               .texcoords = texcoords}};
      card.baseColorPixels = pixels;
      card.baseColorWidth = 2;
      card.baseColorHeight = 1;
      card.alphaCutoff = 0.5f;
      ObjectId id = 0;
      EXPECT_TRUE(renderer.engine().addObject(card, id).ok());
      (void)renderer.render(Configuration{technique}, Output::visibility);
    };
    render({});
    EXPECT_FALSE(givesReason(kDraws)) << technique;
    // Of casters: receivers have their own proofs.
    render([](const DrawnProgram& program) {
      return program.defines().find("ALPHA_MASK") != std::string::npos &&
             program.fragment.find("halfshadow_visibility") == std::string::npos;
    });
    EXPECT_TRUE(givesReason(kDraws)) << technique;
    expectNothingDropped();
  }
}

// As where blending is part of what is compiled.
TEST_F(DroppedPrograms, AreFoundWithTheBlendingOfTheirUse) {
  const auto blended = [](const DrawnProgram& program) {
    return !program.blend.empty() && program.file().starts_with("wedge/");
  };
  SceneRenderer& renderer = start(blended);
  renderer.render(Configuration{"wedges"}, Output::shaded);
  EXPECT_TRUE(givesReason(kDraws));
  expectNothingDropped();
}

TEST_F(DroppedPrograms, OfOneLightAmongSeveralGiveItsReason) {
  SceneRenderer& renderer = start(ofFile("map/pcss.frag"));
  auto lights = builtinScene(kScene).lights;
  lights.push_back(lights[0]);
  lights[1].centerWorld.x += 3.0;
  renderer.setLights(lights);
  const Image image = renderer.render(Configuration{"pcss"}, Output::shaded);
  EXPECT_TRUE(renderer.report().hasSkip("light 0 pcss", kDraws));
  EXPECT_TRUE(renderer.report().hasSkip("light 1 pcss", kDraws));
  EXPECT_EQ(background(image), background(start({}).render(Configuration{"none"}, Output::shaded)));
}

TEST_F(DroppedPrograms, OfAHostsOwnReceiversTooTakeAFallback) {
  SceneRenderer& renderer = start(ofFile("map/block_bounds.frag"));
  renderer.choose({"pcf-masked"});
  renderer.desc().output = Output::lightsOnly;
  FrameReport report;
  ASSERT_TRUE(renderer.engine().render(renderer.desc(), report).ok());
  EXPECT_TRUE(reportOf(report).hasSkip("light 0 pcf-masked", kDraws));
  ForwardRecord forward;
  EXPECT_TRUE(renderer.engine().forwardSource(0, forward).ok());
}

class Proofs : public DroppedPrograms {
 protected:
  std::uint64_t readBacksOf(SceneRenderer& renderer, const char* technique, Output output) {
    renderer.choose({technique});
    renderer.desc().output = output;
    const std::uint64_t before = layer().readBacks();
    EXPECT_TRUE(renderer.engine().render(renderer.desc()).ok());
    return layer().readBacks() - before;
  }
};

TEST_F(Proofs, AreReadBackOnceAFrameThatLinksAndNeverAgain) {
  SceneRenderer& renderer = start({});
  EXPECT_EQ(readBacksOf(renderer, "pcss-mip", Output::visibility), 1u);
  EXPECT_EQ(readBacksOf(renderer, "pcss-mip", Output::shaded), 1u);
  EXPECT_EQ(readBacksOf(renderer, "pcss-mip", Output::visibility), 0u);
  EXPECT_EQ(readBacksOf(renderer, "none", Output::visibility), 1u);
  EXPECT_EQ(readBacksOf(renderer, "pcss-mip", Output::shaded), 0u);
}

TEST_F(Proofs, ThatAHostKeptSpareTheReadBackAndTellTheSame) {
  SceneRenderer& first = start(ofFile("map/pcss.frag"));
  const Image image = first.render(Configuration{"pcss"}, Output::shaded);
  const std::string kept = first.engine().programProofs();
  SceneRenderer& second = start(ofFile("map/pcss.frag"), kept.c_str());
  EXPECT_EQ(readBacksOf(second, "pcss", Output::shaded), 0u);
  EXPECT_EQ(second.render(Output::shaded).rgba, image.rgba);
  EXPECT_TRUE(givesReason(kDraws));
  EXPECT_EQ(second.engine().programProofs(), kept);
}

TEST_F(Proofs, OfAnotherDriverOrCutShortCountForNothing) {
  SceneRenderer& first = start({});
  first.render(Configuration{"hard"}, Output::shaded);
  const std::string kept = first.engine().programProofs();
  std::string other = kept;
  other.replace(other.find('\n') + 1, 1, "X");
  for (const std::string& text :
       {other, kept.substr(0, kept.size() - 3), std::string("no proofs"), std::string()}) {
    EXPECT_EQ(readBacksOf(start({}, text.c_str()), "hard", Output::shaded), 1u) << text;
  }
}

// A driver on which nothing can be proven is taken at its word, and says so; it is not asked again and again.
TEST_F(Proofs, ThatFailAreNotTriedAgain) {
  const Image honest = start({}).render(Configuration{"hard"}, Output::visibility);
  SceneRenderer& blind = start({});
  // What marks depths that nothing has written.
  layer().drop([](const DrawnProgram& program) { return program.file().empty(); });
  EXPECT_EQ(readBacksOf(blind, "hard", Output::visibility), 1u);
  blind.desc().camera.eye[0] += 0.01;
  EXPECT_EQ(readBacksOf(blind, "hard", Output::visibility), 0u);
  blind.desc().camera.eye[0] -= 0.01;
  EXPECT_EQ(blind.render(Output::visibility).rgba, honest.rgba);
  EXPECT_TRUE(blind.report().hasSkip("proof of programs", "unproven"));
  EXPECT_EQ(std::string(blind.engine().programProofs()).find(" dropped"), std::string::npos);
}

// What such programs write depends on what was there, or is nothing at all where their uniforms are 0.
TEST_F(Proofs, FindThatProgramsDrawWhichAddMultiplyFetchOrDiscard) {
  for (const std::string merge : {"core", "minmax", "fetch"}) {
    SceneRenderer& renderer = start({});
    renderer.render(
        Configuration{"wedges-blended", {{"wedges-blended.merge", merge}, {"wedges-blended.cog", "on"}}});
    EXPECT_FALSE(givesReason(kDraws)) << merge;
  }
  for (const std::string route : {"scatter", "fetch"}) {
    start({}).render(Configuration{"wedges-cells", {{"wedges-cells.route", route}}});
    EXPECT_FALSE(givesReason(kDraws)) << route;
  }
  for (const std::string& technique : techniques()) {
    start({}).render(Configuration{technique});
    EXPECT_FALSE(givesReason(kDraws)) << technique;
  }
}

TEST_F(Proofs, DoNotCountAsTheFramesOwnDraws) {
  SceneRenderer& renderer = start({});
  renderer.render(Configuration{"pcf-masked"}, Output::visibility);
  const Report first = renderer.report();
  renderer.desc().camera.eye[0] += 0.01;
  renderer.render(Output::visibility);
  renderer.desc().camera.eye[0] -= 0.01;
  auto lights = builtinScene(kScene).lights;
  lights[0].centerWorld.x += 0.01;
  renderer.setLights(lights);
  renderer.render(Output::visibility);
  EXPECT_EQ(first.draws, renderer.report().draws);
  EXPECT_EQ(first.framebufferSwitches, renderer.report().framebufferSwitches);
}

}  // namespace
}  // namespace halfshadow::test
