// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Occlusion textures: refusals, degenerate scenes, and work that is not done twice.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "analytic_scenes.hpp"

namespace halfshadow::test {
namespace {

using OcclusionLimits = SharedEngineTest;

scene::SceneDescription boxesOverGround(std::initializer_list<glm::dvec3> centers) {
  scene::SceneDescription scene{.name = "boxes"};
  for (const glm::dvec3& center : centers) scene.objects.push_back(boxObject(center, {0.5, 0.2, 0.5}));
  scene.objects.push_back(groundPlane(20.0));
  scene.camera = cameraAbove(0.0, 0.0, 3.0);
  scene.lights = {lightAbove({0, 12, 0}, 0.5, 0.5)};
  return scene;
}

TEST_F(OcclusionLimits, SettingsOutOfRangeAreRefusedWithTheRange) {
  Engine& engine = renderer().engine();
  for (const char* slices : {"3", "17", "0", "-4", "four"}) {
    const Outcome outcome = engine.set("occlusion-textures.slices", slices);
    EXPECT_EQ(outcome.code, ErrorCode::invalidArgument) << slices;
    EXPECT_NE(std::string(outcome.message).find("4"), std::string::npos) << outcome.message;
  }
  for (const char* size : {"32", "2048"})
    EXPECT_FALSE(engine.set("occlusion-textures.map_size", size).ok()) << size;
  for (const char* filter : {"", "sum", "nbuffers"})
    EXPECT_FALSE(engine.set("occlusion-textures.filter", filter).ok()) << filter;
}

TEST_F(OcclusionLimits, MapSidesThatCannotBeHalvedAreRefused) {
  renderer().load(boxesOverGround({{0, 2, 0}}));
  renderer().choose({"occlusion-textures", {{"occlusion-textures.map_size", "100"}}});
  FrameReport report;
  const Outcome outcome = renderer().engine().render(renderer().desc(), report);
  EXPECT_EQ(outcome.code, ErrorCode::invalidArgument);
  EXPECT_NE(std::string(outcome.message).find("power of two"), std::string::npos) << outcome.message;
  renderer().choose({"none"});
}

TEST_F(OcclusionLimits, UnchangedFramesRunNoLightPass) {
  renderer().load(boxesOverGround({{0, 2, 0}}));
  for (const char* filter : {"nbuffer", "sat", "mipmap"}) {
    for (const char* preset : {"tuned", "paper"}) {
      const Configuration configuration{
          "occlusion-textures",
          {{"occlusion-textures.filter", filter}, {"occlusion-textures.preset", preset}}};
      const Image first = renderer().render(configuration);
      EXPECT_GE(renderer().report().lightPasses(), 2u) << filter;
      const Image second = renderer().render();
      EXPECT_EQ(renderer().report().lightPasses(), 0u) << filter << " " << preset;
      EXPECT_EQ(first.rgba, second.rgba);
    }
  }
}

TEST_F(OcclusionLimits, EmptySlicesAreSkippedWithAReason) {
  renderer().load(boxesOverGround({{0, 1, 0}, {0, 7, 0}}));
  const Image image =
      renderer().render({"occlusion-textures", {{"occlusion-textures.slices", "8"}, {"sub_lights", "1"}}});
  std::size_t skipped = 0;
  for (const Skip& skip : renderer().report().skips)
    skipped += skip.what.find("occlusion slice") != std::string::npos;
  // Boxes .4 high in slices of .8: the first and the last hold them.
  EXPECT_EQ(skipped, 6u);
  EXPECT_TRUE(renderer().report().hasSkip("light 0 occlusion slice 4", "no caster"));
  // Two slices share one texture: one pass slices, one averages.
  std::size_t slicing = 0;
  for (const Pass& pass : renderer().report().passes)
    slicing += pass.name.find("occlusion slices") != std::string::npos;
  EXPECT_EQ(slicing, 2u);
  EXPECT_LE(image.byte(static_cast<std::size_t>(kHeight / 2 * kWidth + kWidth / 2)), 2)
      << "the middle lies in the umbra of both boxes";
}

TEST_F(OcclusionLimits, CastersBehindTheLightCastNothing) {
  renderer().load(boxesOverGround({{0, 15, 0}}));
  const Image image = renderer().render(Configuration{"occlusion-textures"});
  EXPECT_TRUE(std::ranges::all_of(image.rgba, [](std::uint8_t byte) { return byte == 255; }));
}

// The part in front of the light shadows; what the picture is there is the near cut's matter, but it is a
// picture.
TEST_F(OcclusionLimits, LightsInsideCastersStillShadow) {
  renderer().load(boxesOverGround({{0, 12, 0}, {1.5, 3, 0}}));
  for (const char* center : {"light", "behind"}) {
    for (const char* projection : {"perspective", "orthographic"}) {
      const Image image = renderer().render(
          {"occlusion-textures",
           {{"occlusion-textures.center", center}, {"occlusion-textures.projection", projection}}});
      EXPECT_TRUE(std::ranges::any_of(image.rgba, [](std::uint8_t byte) { return byte < 255; }))
          << center << projection;
    }
  }
}

TEST_F(OcclusionLimits, PointLightsGiveHardShadows) {
  scene::SceneDescription scene = boxesOverGround({{0, 3, 0}});
  scene.lights = {lightAbove({0, 12, 0}, 0.0, 0.0)};
  renderer().load(scene);
  const Image image = renderer().render(Configuration{"occlusion-textures"});
  std::size_t dark = 0, between = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    dark += image.byte(i) < 3;
    between += image.byte(i) >= 3 && image.byte(i) < 253;
  }
  // A shadow of 1.36 squared in 6 x 8 units: 1060 pixels, whose outline of 130 is blurred by a texel at most.
  EXPECT_NEAR(static_cast<double>(dark + between / 2), 1060.0, 80.0);
  EXPECT_LE(between, 200u);
}

TEST_F(OcclusionLimits, TinyAndFarAwayWorldsGiveTheSameImage) {
  renderer().load(builtinScene("figure@light=1"));
  const Configuration configuration{"occlusion-textures"};
  const Image reference = renderer().render(configuration);
  for (const char* name : {"tiny", "large-world"}) {
    renderer().load(builtinScene(name));
    const Image image = renderer().render(configuration);
    double sum = 0.0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
      sum += std::abs(image.byte(i) - reference.byte(i)) / 255.0;
    // Matrices are made in double; what differs is the last bit of their float images, which flips pixels of
    // outlines (also those of the scene against its background) and texels on the borders of the map's.
    EXPECT_LE(sum / static_cast<double>(image.pixels()), 0.002) << name;
  }
}

TEST_F(OcclusionLimits, GroundBeyondTheMapIsFullyLitWithoutAFetch) {
  renderer().load(builtinScene("box@light=0.3"));
  const Configuration configuration{"occlusion-textures"};
  const Image visibility = renderer().render(configuration);
  const Image counts = renderer().render(configuration, Output::taps);
  std::size_t unfetched = 0;
  for (std::size_t i = 0; i < counts.pixels(); ++i) {
    if (counts.byte(i, 0) != 0) continue;
    ++unfetched;
    ASSERT_EQ(visibility.byte(i), 255);
  }
  EXPECT_GT(unfetched, counts.pixels() / 10);
}

}  // namespace
}  // namespace halfshadow::test
