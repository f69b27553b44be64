// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "cli_process.hpp"
#include "images/images.hpp"

namespace halfshadow::cli_tests {
namespace {
using nlohmann::json;

std::vector<std::string> renderBox(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"render", "builtin:box", "--size", "64x48", "-t", "pcss"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

images::FloatImage readImage(const std::string& file) {
  auto image = images::readImage(file);
  if (image) return std::move(image).value();
  ADD_FAILURE() << image.error().message;
  return {};
}

TEST_F(CliTest, RenderWritesImageVisibilityAndPlan) {
  const json report =
      runJson(renderBox({"-o", path("a.png"), "--visibility", path("v.exr"), "--graphviz", path("p.dot")}));
  EXPECT_EQ(report["technique"], "pcss");
  EXPECT_FALSE(report["passes"].empty());
  const images::FloatImage image = readImage(path("a.png"));
  EXPECT_EQ(image.width, 64);
  EXPECT_EQ(image.height, 48);
  EXPECT_EQ(image.channels, 3);
  const auto [low, high] = std::ranges::minmax(image.pixels);
  EXPECT_GT(high - low, 0.2f) << "a picture, not one tone";
  const images::FloatImage visibility = readImage(path("v.exr"));
  EXPECT_EQ(visibility.channelNames, std::vector<std::string>{"V"});
  const auto [dark, light] = std::ranges::minmax(visibility.pixels);
  EXPECT_EQ(dark, 0.0f);
  EXPECT_EQ(light, 1.0f);
  EXPECT_GT(std::filesystem::file_size(path("p.dot")), 0u);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "p.dot", "v.exr"}));
}

TEST_F(CliTest, PlanIsText) {
  const ProcessResult result = run(renderBox({"--plan"}));
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.output.find("receivers"), std::string::npos) << result.output;
}

TEST_F(CliTest, RenderIsDeterministic) {
  runJson(renderBox({"--visibility", path("a.exr")}));
  runJson(renderBox({"--visibility", path("b.exr")}));
  EXPECT_EQ(readImage(path("a.exr")).pixels, readImage(path("b.exr")).pixels);
}

TEST_F(CliTest, FramesAreNumberedAndMove) {
  for (const char* motion : {"light", "camera"}) {
    SCOPED_TRACE(motion);
    runJson(renderBox({"--visibility", path("v.exr"), "--frames", "3", "--animate", motion}));
    EXPECT_EQ(files(), (std::vector<std::string>{"v_0000.exr", "v_0001.exr", "v_0002.exr"}));
    EXPECT_NE(readImage(path("v_0000.exr")).pixels, readImage(path("v_0001.exr")).pixels);
    EXPECT_NE(readImage(path("v_0001.exr")).pixels, readImage(path("v_0002.exr")).pixels);
  }
}

TEST_F(CliTest, TheFirstFrameIsTheStillImage) {
  runJson(renderBox({"--visibility", path("v.exr"), "--frames", "1"}));
  runJson(renderBox({"--visibility", path("still.exr")}));
  EXPECT_EQ(readImage(path("v_0000.exr")).pixels, readImage(path("still.exr")).pixels);
}

TEST_F(CliTest, AnAnimatedFileIsPosedPerFrame) {
  const std::string model = std::string(HALFSHADOW_SHARED_DIR) + "/scenes/CesiumMan.glb";
  if (!std::filesystem::exists(model)) GTEST_SKIP() << model << " is not there";
  runJson({"render", model, "--visibility", path("v.exr"), "-t", "hard", "--size", "64x48", "--frames", "2",
           "--animate", "time", "--fps", "2"});
  runJson({"render", model, "--visibility", path("still.exr"), "-t", "hard", "--size", "64x48"});
  EXPECT_EQ(readImage(path("v_0000.exr")).pixels, readImage(path("still.exr")).pixels);
  EXPECT_NE(readImage(path("v_0001.exr")).pixels, readImage(path("still.exr")).pixels);
}

TEST_F(CliTest, APictureOfNothingIsAnError) {
  const std::string away = "eye=0,3,10 target=0,9,20";
  expectFailure(renderBox({"-o", path("a.png"), "--camera", away}), 1, {"empty", "--camera"});
  expectFailure(renderBox({"--visibility", path("v.exr"), "--camera", away}), 1, {"empty", "--camera"});
  expectFailure({"measure", "builtin:box", "-t", "hard", "--samples", "16", "--size", "32x24", "--frames",
                 "0", "--camera", away},
                1, {"nothing to measure"});
  // One colour all over, but a surface.
  runJson(renderBox({"--visibility", path("v.exr"), "--camera", "eye=15,3,0 target=15,0,0.1"}));
}

TEST_F(CliTest, BrightnessDependsOnTheLightAlone) {
  // The pixels that a raised box leaves lit keep their colour, whatever it is that casts.
  const std::string camera = "eye=9,9,9 target=4,0,4 fov=20",
                    light = "center=2,9,1 target=0,0,0 size=0.2x0.2";
  std::vector<float> first;
  for (const char* scene : {"builtin:box", "builtin:spheres27", "builtin:bars"}) {
    for (const char* technique : {"hard", "none"}) {
      runJson({"render", scene, "-o", path("a.png"), "--size", "32x24", "-t", technique, "--camera", camera,
               "--light", light});
      const std::vector<float> pixels = readImage(path("a.png")).pixels;
      const std::vector<float> bottomRow(pixels.end() - 96, pixels.end());
      if (first.empty()) first = bottomRow;
      EXPECT_EQ(bottomRow, first) << scene;
    }
  }
}

TEST_F(CliTest, CameraLightAndGroundOptionsChangeTheImage) {
  const std::vector<std::vector<std::string>> variants{{},
                                                       {"--camera", "eye=5,6,7 target=0,1,0 fov=40"},
                                                       {"--light", "center=2,9,4 target=0,1,0 size=2x1"},
                                                       {"--ground", "off"}};
  std::vector<std::vector<float>> images;
  for (const auto& variant : variants) {
    std::vector<std::string> arguments = renderBox({"--visibility", path("v.exr")});
    arguments.insert(arguments.end(), variant.begin(), variant.end());
    runJson(arguments);
    images.push_back(readImage(path("v.exr")).pixels);
    for (std::size_t i = 0; i + 1 < images.size(); ++i) EXPECT_NE(images[i], images.back());
  }
}
}  // namespace
}  // namespace halfshadow::cli_tests
