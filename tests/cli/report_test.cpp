// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <fstream>
#include <sstream>

#include "cli_process.hpp"

namespace halfshadow::cli_tests {
namespace {
using nlohmann::json;

std::string textOf(const std::string& file) {
  std::ifstream stream(file);
  EXPECT_TRUE(stream) << file;
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_F(CliTest, ReportShowsEveryTechniqueOfAScene) {
  const ProcessResult result = run({"report", "builtin:box", "-o", path("out"), "-t", "hard,pcf", "--size",
                                    "64x48", "--samples", "16", "--frames", "1"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const std::string page = textOf(path("out/report.html"));
  EXPECT_EQ(count(page, "<section "), 1u);
  // The shaded picture, the truth, and visibility and error map of two techniques.
  EXPECT_EQ(count(page, "<img "), 6u);
  EXPECT_TRUE(std::filesystem::exists(path("out/box-pcf.png")));
}

TEST_F(CliTest, ReportRepeatsThePapersComparisons) {
  const ProcessResult result =
      run({"report", "--papers", "-o", path("out"), "--samples", "4", "--frames", "0"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const std::string page = textOf(path("out/report.html"));
  for (const char* title : {"Figure 2: filtering methods", "Figure 3: maximum, sum", "Table 1: frames per",
                            "penumbra-wedges blending", "halfshadow profile evans"}) {
    EXPECT_NE(page.find(title), std::string::npos) << title;
  }
  const json papers = json::parse(textOf(path("out/papers.json")));
  ASSERT_EQ(papers.size(), 3u);
  // Two presets with three filters at two sizes; three combinations and the tuned one in two scenes.
  const json& occlusion = papers[0]["comparisons"];
  ASSERT_EQ(occlusion.size(), 4u);
  EXPECT_EQ(occlusion[0]["result"]["variants"].size(), 6u);
  EXPECT_EQ(occlusion[2]["result"]["variants"].size(), 4u);
  // Two builds, three sizes, four starts, two numbers of neighbours.
  const json& width = papers[1]["comparisons"];
  ASSERT_EQ(width.size(), 2u);
  EXPECT_EQ(width[0]["result"]["variants"].size(), 48u);
  for (const json& variant : width[0]["result"]["variants"]) {
    EXPECT_GT(variant["error"]["penumbra"]["rmse"].get<double>(), 0.0) << variant["label"];
  }
}

TEST_F(CliTest, ReportWithoutScenesAndPapersIsBadUsage) {
  expectFailure({"report", "-o", path("out")}, 2, {"--papers"});
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace halfshadow::cli_tests
