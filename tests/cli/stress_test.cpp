// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "cli_process.hpp"

namespace halfshadow::cli_tests {
namespace {
using nlohmann::json;

const std::vector<std::string> kSmall = {"--size", "48x36", "--samples", "36"};

std::vector<std::string> stress(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "stress");
  arguments.insert(arguments.end(), kSmall.begin(), kSmall.end());
  return arguments;
}

TEST_F(CliTest, StressListsItsCasesWithoutADevice) {
  const ProcessResult result = run({"stress", "--list", "--egl-library", "/does/not/exist"});
  ASSERT_EQ(result.status, 0) << result.errors;
  for (const char* name : {"scale", "lamp-post", "casting-ground", "inside", "sun", "turning"})
    EXPECT_NE(result.output.find(name), std::string::npos) << name;
}

TEST_F(CliTest, StressJudgesTechniquesAndTheRayTracer) {
  const json document = runJson(stress({"mirror", "-t", "hard,none,pcss", "--seed", "5"}));
  EXPECT_EQ(document["techniques"], json::array({"hard", "pcss", "reference"})) << "none draws no shadow";
  EXPECT_EQ(document["seed"], 5);
  EXPECT_EQ(document["counts"]["ok"], 3);
  ASSERT_EQ(document["cases"].size(), 1u);
  const json& mirror = document["cases"][0];
  EXPECT_EQ(mirror["name"], "mirror");
  ASSERT_EQ(mirror["cells"].size(), 3u);
  for (const json& cell : mirror["cells"]) {
    EXPECT_EQ(cell["verdict"], "ok") << cell;
    for (const json& variant : cell["variants"]) {
      EXPECT_GT(variant["error"]["pixels"].get<int>(), 500);
      EXPECT_GT(variant["error"]["penumbra_pixels"].get<int>(), 20);
      EXPECT_TRUE(variant.contains("error_base_scene"));
    }
  }
}

TEST_F(CliTest, StressFailsWhereACellIsWrongAndLeavesItsPicture) {
  // 16 texels a side cannot show 70 leaves.
  const ProcessResult result =
      run(stress({"base", "-t", "hard", "--set", "map_size=16", "--dump", path("pictures")}));
  EXPECT_EQ(result.status, 1) << result.output << result.errors;
  EXPECT_NE(result.output.find("WRONG"), std::string::npos);
  EXPECT_NE(result.errors.find("wrong"), std::string::npos);
  const std::vector<std::string> left = files();
  EXPECT_TRUE(
      std::ranges::any_of(left, [](const std::string& f) { return f.ends_with("base-leaves-hard.png"); }));
}

TEST_F(CliTest, StressNamesUnknownCases) {
  expectFailure({"stress", "earthquake"}, 2, {"earthquake", "lamp-post"});
  expectFailure({"stress", "scale", "-t", "radiosity"}, 2, {"radiosity"});
  expectFailure({"stress", "scale", "--samples", "0"}, 2, {"--samples"});
}

}  // namespace
}  // namespace halfshadow::cli_tests
