// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every way to call the tool wrongly: exit status, a message that names what is wrong, nothing left behind.
#include <sys/stat.h>

#include <fstream>

#include "cli_process.hpp"

namespace halfshadow::cli_tests {
namespace {
constexpr int kFailed = 1, kBadUsage = 2;

TEST_F(CliTest, HelpIsNotAnError) {
  const ProcessResult top = run({"--help"});
  EXPECT_EQ(top.status, 0);
  for (const char* command :
       {"info", "techniques", "scenes", "render", "reference", "measure", "compare", "validate", "stress"}) {
    EXPECT_NE(top.output.find(command), std::string::npos) << command;
    const ProcessResult help = run({command, "--help"});
    EXPECT_EQ(help.status, 0) << command;
    EXPECT_NE(help.output.find("--json"), std::string::npos) << command;
  }
}

TEST_F(CliTest, UnknownCommandsAndOptionsAreBadUsage) {
  expectFailure({}, kBadUsage, {"command", "measure"});
  expectFailure({"bogus"}, kBadUsage, {"bogus", "render"});
  expectFailure({"scenes", "--bogus"}, kBadUsage, {"--bogus"});
  expectFailure({"render"}, kBadUsage, {"SCENE"});
  expectFailure({"render", "builtin:box"}, kBadUsage, {"-o"});
  expectFailure({"render", "builtin:nope", "-o", path("a.png")}, kBadUsage, {"nope", "box"});
}

TEST_F(CliTest, SuitesTravelWithTheTool) {
  expectFailure({"profile", "nope", "-o", path("profile")}, kFailed,
                {"nope", "evans, forest, occlusion, quick"});
  EXPECT_TRUE(files().empty());
  // Were they read from where the tool was built, then its path would stand in the binary.
  std::ifstream binary(HALFSHADOW_CLI, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(binary), std::istreambuf_iterator<char>()};
  EXPECT_NE(bytes.find("\"GC2000\""), std::string::npos) << "a device profile";
  EXPECT_EQ(bytes.find(HALFSHADOW_PROFILES), std::string::npos);
}

TEST_F(CliTest, OptionValuesAreCheckedBeforeAnyWork) {
  const auto render = [this](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", "builtin:box", "-o", path("a.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  for (const char* size : {"0x48", "64x0", "-1x4", "64", "x", "64x48x2", "nanx4", "99999x4", "1e3x4"}) {
    expectFailure(render({"--size", size}), kBadUsage, {"--size", size, "640x480"});
  }
  for (const char* light :
       {"center=nan,1,0 target=0,0,0 size=1x1", "center=0,1,0", "center=0,1,0 target=0,1,0 size=1x1",
        "center=0,9,0 target=0,0,0 size=-1x1", "center=0,inf,0 u=1,0,0 v=0,0,1", "bogus"}) {
    expectFailure(render({"--light", light}), kBadUsage, {"--light"});
  }
  for (const char* camera : {"eye=nan,1,0 target=0,0,0", "eye=0,0,0", "eye=1,1,1 target=1,1,1",
                             "eye=0,9,0 target=0,0,1 fov=0", "eye=0,9,0 target=0,0,1 fov=180"}) {
    expectFailure(render({"--camera", camera}), kBadUsage, {"--camera"});
  }
  expectFailure(render({"--animation-time", "nan"}), kBadUsage, {"--animation-time", "nan"});
  expectFailure(render({"--ground", "maybe"}), kBadUsage, {"--ground", "maybe"});
  expectFailure(render({"--driver", "voodoo"}), kBadUsage, {"--driver", "voodoo", "llvmpipe"});
  expectFailure(render({"--force", "bogus=off"}), kBadUsage, {"--force", "bogus", "depth-texture"});
  expectFailure(render({"--force", "highp=on"}), kBadUsage, {"--force", "highp=on"});
  expectFailure(render({"--set", "pcf.size"}), kBadUsage, {"--set", "pcf.size"});
  expectFailure(render({"--set", "pcf.bogus=1"}), kBadUsage, {"--set", "pcf.bogus", "pcf.size"});
  expectFailure(render({"--set", "pcf.size=99"}), kBadUsage, {"--set", "pcf.size", "17"});
  expectFailure(render({"--set", "map_size=nan"}), kBadUsage, {"--set", "map_size"});
  expectFailure(render({"-t", "bogus"}), kBadUsage, {"-t", "bogus", "pcf"});
  expectFailure(render({"--frames", "0"}), kBadUsage, {"--frames"});
  expectFailure(render({"--animate", "light"}), kBadUsage, {"--animate", "--frames"});
  expectFailure(render({"--animate", "time", "--frames", "2"}), kBadUsage, {"--animate time", "builtin:box"});
  expectFailure(render({"--fps", "inf"}), kBadUsage, {"--fps"});
  expectFailure({"render", "builtin:box", "-o", path("a.bmp")}, kBadUsage, {"a.bmp", ".png"});
  expectFailure({"render", "builtin:box@light=-1", "-o", path("a.png")}, kBadUsage, {"light"});
  EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(CliTest, MeasureRefusesBadListsAndCounts) {
  expectFailure({"measure", "builtin:box", "-t", "hard,bogus"}, kBadUsage, {"-t", "bogus", "pcf"});
  expectFailure({"measure", "builtin:box", "--samples", "0"}, kBadUsage, {"--samples"});
  expectFailure({"measure", "builtin:box", "--samples", "many"}, kBadUsage, {"--samples"});
  expectFailure({"measure", "builtin:box", "--frames", "-1"}, kBadUsage, {"--frames"});
  expectFailure({"reference", "builtin:box"}, kBadUsage, {"-o"});
  expectFailure({"compare", path("a.exr")}, kBadUsage, {"B"});
}

TEST_F(CliTest, MissingAndBrokenFilesFail) {
  std::ofstream(path("broken.glb")) << "not a model";
  std::ofstream(path("broken.exr")) << "not an image";
  expectFailure({"render", path("none.glb"), "-o", path("a.png")}, kFailed, {"none.glb"});
  expectFailure({"render", path("broken.glb"), "-o", path("a.png")}, kFailed, {"broken.glb"});
  expectFailure({"measure", path("none.glb")}, kFailed, {"none.glb"});
  expectFailure({"reference", path("none.glb"), "-o", path("v.exr")}, kFailed, {"none.glb"});
  expectFailure({"validate", path("broken.glb")}, kFailed, {"broken.glb"});
  expectFailure({"compare", path("none.exr"), path("none.exr")}, kFailed, {"none.exr"});
  expectFailure({"compare", path("broken.exr"), path("broken.exr")}, kFailed, {"broken.exr"});
  expectFailure({"info", "--egl-library", path("none.so")}, kFailed, {"none.so"});
  EXPECT_EQ(files(), (std::vector<std::string>{"broken.exr", "broken.glb"}));
}

TEST_F(CliTest, UnwritableOutputsFailBeforeTheWork) {
  const std::string missing = path("missing/file");
  std::ofstream(path("occupied")) << "a file";
  expectFailure({"render", "builtin:box", "-o", missing + ".png"}, kFailed, {"-o", "missing"});
  expectFailure({"render", "builtin:box", "--visibility", missing + ".exr"}, kFailed,
                {"--visibility", "missing"});
  expectFailure({"render", "builtin:box", "--graphviz", missing}, kFailed, {"--graphviz", "missing"});
  expectFailure({"render", "builtin:box", "--graphviz", folder_.string()}, kFailed, {"--graphviz", "folder"});
  expectFailure({"reference", "builtin:box", "-o", missing + ".exr"}, kFailed, {"-o", "missing"});
  expectFailure({"measure", "builtin:box", "--json", missing}, kFailed, {"--json", "missing"});
  expectFailure({"measure", "builtin:box", "--dump", path("occupied")}, kFailed, {"--dump", "occupied"});
  EXPECT_EQ(files(), std::vector<std::string>{"occupied"});
}

TEST_F(CliTest, ImagesOfDifferentSizesCannotBeCompared) {
  for (const char* size : {"16x12", "20x15"}) {
    run({"reference", "builtin:box", "--size", size, "--samples", "1", "-o",
         path(std::string(size) + ".exr")});
  }
  expectFailure({"compare", path("16x12.exr"), path("20x15.exr")}, kFailed, {"16x12", "20x15"});
}

TEST_F(CliTest, DevicesAreWrittenNotReplaced) {
  // Names that a regression cannot damage: nothing can be renamed into /proc/self/fd, and the pipe is ours.
  const ProcessResult result = run({"scenes", "--json", "/dev/fd/2"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.errors.find("\"scenes\""), std::string::npos);
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  expectFailure({"render", "builtin:box", "--graphviz", path("pipe")}, kFailed, {"--graphviz", "pipe"});
  EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));
}

TEST_F(CliTest, AFileOfThatNameStaysWhenTheWorkFails) {
  std::ofstream(path("a.png")) << "precious";
  expectFailure({"render", path("none.glb"), "-o", path("a.png")}, kFailed, {"none.glb"});
  std::string text;
  std::ifstream(path("a.png")) >> text;
  EXPECT_EQ(text, "precious");
}
}  // namespace
}  // namespace halfshadow::cli_tests
