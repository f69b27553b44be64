// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What a frame costs and what it leaves out, as its report says it.
#include <algorithm>
#include <ostream>

#include "analytic_scenes.hpp"
#include "reference/reference.hpp"
#include "truth.hpp"

namespace halfshadow::test {
namespace {

struct Cost {
  Configuration configuration;
  std::size_t lightPasses;       ///< of a frame in which everything is new
  std::size_t screenPasses = 0;  ///< of every frame that is drawn, before the one over the receivers
};
void PrintTo(const Cost& cost, std::ostream* stream) {
  *stream << cost.configuration.text();
}

// Depth map 1; block bounds for a kernel one pass per factor of four or two and one that dilates; penumbra
// bounds two sources of blocks and their levels along two axes; occupancy, its second source and its levels
// 3; the mip chain's edge mask 2; moments 1 and their blur 2. Four slices in pairs, fine and kept, and eight
// levels and an N-buffer for each of the two textures. Coverage, seeds, six floods from 32 texels to 1, six
// boxes and their atlas, and the map of widths; of a split light, whose penumbrae are a third as wide, three
// floods and three boxes, and its penumbra bounds.
const std::vector<Cost> kCosts = {
    {{"none"}, 0},
    {{"hard"}, 1},
    {{"pcf"}, 1},
    {{"pcf-masked"}, 1 + 2},
    {{"pcf-masked", {{"pcf-masked.mask", "laplacian5"}}}, 1 + 2},
    {{"pcf-quantized", {{"pcf-quantized.preset", "paper"}}}, 1 + 2},
    {{"vsm"}, 1 + 3},
    {{"pcss"}, 1 + 4},
    {{"pcss-mip"}, 1 + 4 + 3},
    {{"pcf-quantized"}, 1 + 4 + 3},
    // Without highp casters are drawn into both slice textures, else once and then sorted into them.
    {{"occlusion-textures"}, (isForcedOff("highp") ? 2u : 1u) + 2 + 2 * (6 + 1)},
    {{"shadow-width", {{"sub_lights", "1"}}}, 1 + 2 + 6 + 7 + 1},
    {{"shadow-width"}, 1 + 2 + 3 + 4 + 1 + 4},
    {{"shadow-volume"}, 0, 1},
    {{"wedges-cells"}, 0},
    {{"wedges-blended"}, 0},
    // Receivers' depth and sums; receivers that carry the silhouettes test a depth buffer of their own.
    {{"wedges"}, 0, 2},
    {{"wedges", {{"wedges.route", "receivers"}}}, 0, 1},
    // Depth, casters of one piece, and two passes for each batch of the others: eleven casters that touch are
    // one.
    {{"wedges-probabilistic"}, 0, 2 + 2 * 1},
};

class Counters : public SharedEngineTest, public testing::WithParamInterface<Cost> {
 protected:
  void SetUp() override {
    SharedEngineTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    std::string reason;
    if (!supports(GetParam().configuration.technique, reason)) GTEST_SKIP() << reason;
    renderer().load(builtinScene("figure@light=0.3"));
    first_ = renderer().render(GetParam().configuration);
    firstReport_ = renderer().report();
  }
  Image first_;
  Report firstReport_;
};
class FrameReports : public SharedEngineTest {};

std::string passNames(const Report& report) {
  std::string names;
  for (const Pass& pass : report.passes) names += pass.name + "; ";
  return names;
}

TEST_P(Counters, FirstFrameMakesEveryLightPassOnce) {
  EXPECT_EQ(firstReport_.lightPasses(), GetParam().lightPasses) << passNames(firstReport_);
  EXPECT_EQ(firstReport_.passes.size(), GetParam().lightPasses + GetParam().screenPasses + 1)
      << "and one pass over the receivers: " << passNames(firstReport_);
  // Tile-based GPUs pay for each switch: one framebuffer a pass, none twice.
  EXPECT_EQ(firstReport_.framebufferSwitches, firstReport_.passes.size());
}

TEST_P(Counters, UnchangedFrameDrawsNothing) {
  const Image again = renderer().render();
  EXPECT_EQ(renderer().report().passes.size(), 0u) << passNames(renderer().report());
  EXPECT_EQ(renderer().report().framebufferSwitches, 0u);
  EXPECT_EQ(renderer().report().textureBytesUploaded, 0u);
  EXPECT_EQ(renderer().report().bufferBytesUploaded, 0u);
  EXPECT_EQ(again.rgba, first_.rgba);
  EXPECT_TRUE(renderer().report().hasSkip("light 0", "unchanged"));
}

TEST_P(Counters, CameraMoveMakesNoLightPass) {
  renderer().desc().camera.eye[0] += 0.5;
  const Image moved = renderer().render();
  EXPECT_EQ(renderer().report().lightPasses(), 0u) << passNames(renderer().report());
  EXPECT_EQ(renderer().report().passes.size(), GetParam().screenPasses + 1);
  EXPECT_EQ(renderer().report().framebufferSwitches, GetParam().screenPasses + 1);
  EXPECT_EQ(renderer().report().textureBytesUploaded + renderer().report().bufferBytesUploaded, 0u);
  if (GetParam().lightPasses > 0) {
    EXPECT_TRUE(renderer().report().hasSkip("light 0", "unchanged"));
    EXPECT_NE(moved.rgba, first_.rgba) << "the camera did move";
  }
}

TEST_P(Counters, MovedLightOrCasterMakesThemAllAgain) {
  auto lights = builtinScene("figure@light=0.3").lights;
  lights[0].centerWorld.x += 0.25;
  renderer().setLights(lights);
  renderer().render();
  EXPECT_EQ(renderer().report().lightPasses(), GetParam().lightPasses) << passNames(renderer().report());
  renderer().setLights(lights);
  renderer().render();
  EXPECT_EQ(renderer().report().lightPasses(), 0u) << "the same light set again is no change";

  glm::dmat4 moved = builtinScene("figure@light=0.3").objects[9].worldFromObject;
  moved[3].y += 0.1;
  renderer().setTransform(9, moved);
  renderer().render();
  EXPECT_EQ(renderer().report().lightPasses(), GetParam().lightPasses) << passNames(renderer().report());
}

TEST_P(Counters, EverySkipHasAReason) {
  renderer().render();
  for (const Skip& skip : renderer().report().skips) {
    EXPECT_FALSE(skip.what.empty());
    EXPECT_FALSE(skip.why.empty()) << skip.what;
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Counters, testing::ValuesIn(kCosts), [](const auto& tested) {
  std::string name = tested.param.configuration.technique;
  for (const Setting& setting : tested.param.configuration.settings) name += "_" + setting.value;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST_F(FrameReports, EveryTechniqueHasItsCostsWrittenDown) {
  for (const std::string& id :
       techniquesBut(renderer().engine(), {{"sampled", "it draws 64 maps for each view and keeps none"}})) {
    EXPECT_TRUE(
        std::ranges::any_of(kCosts, [&](const Cost& cost) { return cost.configuration.technique == id; }))
        << id << ": add its passes to kCosts";
  }
}

TEST_F(FrameReports, HardFetchesOnceBehindCastersAndNeverMore) {
  const std::string scene = "figure@light=0.3";
  renderer().load(builtinScene(scene));
  const Image taps = renderer().render(Configuration{"hard"}, Output::taps);
  const Truth& truth = truthOf(scene);
  int fetched = 0, receivers = 0;
  for (std::size_t i = 0; i < taps.pixels(); ++i) {
    if (!truth.interior[i] || truth.kind[i] == reference::kNoReceiver) continue;
    const int count = taps.byte(i, 0) + 256 * taps.byte(i, 1);
    ASSERT_LE(count, 1) << "pixel " << i;
    // What lies nearer to the light than every caster is lit without a fetch; a shadow needs one.
    if (truth.visibility[i] < 1.0f) {
      ASSERT_EQ(count, 1) << "pixel " << i;
    }
    ++receivers, fetched += count;
  }
  EXPECT_GE(fetched, receivers * 9 / 10);
  renderer().desc().camera.target[1] = 100.0;  // nothing but sky
  const Image sky = renderer().render(Output::taps);
  EXPECT_EQ(sky.byte(0, 0), 0);
}

TEST_F(FrameReports, CasterBehindTheLightIsSkippedWithItsReason) {
  scene::SceneDescription scene = PlateOverGround().scene();
  scene.objects.push_back(boxObject({0, 15, 0}, {3, 0.5, 3}));
  renderer().load(scene);
  renderer().render(Configuration{"hard"});
  EXPECT_TRUE(renderer().report().hasSkip("caster " + std::to_string(renderer().id(2)), "behind-light"));
  EXPECT_FALSE(renderer().report().hasSkip("caster " + std::to_string(renderer().id(0)), ""));
}

TEST_F(FrameReports, LightOffAndSceneWithoutCastersAreLit) {
  scene::SceneDescription scene = PlateOverGround().scene();
  scene.lights.front().intensity = 0.0;
  renderer().load(scene);
  const std::vector<std::string> techniques = techniquesBut(renderer().engine(), {});
  for (const std::string& technique : techniques) {
    const Image dark = renderer().render(Configuration{technique});
    EXPECT_EQ(std::ranges::count(dark.rgba, 255), static_cast<std::ptrdiff_t>(dark.rgba.size())) << technique;
    EXPECT_TRUE(renderer().report().hasSkip("light 0", "light-off")) << technique;
    EXPECT_EQ(renderer().report().lightPasses(), 0u) << technique;
  }
  scene.lights.front().intensity = 1.0;
  scene.objects.front().casts = false;
  renderer().load(scene);
  for (const std::string& technique : techniques) {
    const Image lit = renderer().render(Configuration{technique});
    EXPECT_EQ(std::ranges::count(lit.rgba, 255), static_cast<std::ptrdiff_t>(lit.rgba.size())) << technique;
    EXPECT_TRUE(renderer().report().hasSkip("light 0", "no-casters")) << technique;
    EXPECT_EQ(renderer().report().lightPasses(), 0u) << technique;
  }
}

}  // namespace
}  // namespace halfshadow::test
