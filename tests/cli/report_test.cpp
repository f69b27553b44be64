// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "cli_process.hpp"
#include "report_page.hpp"

namespace halfshadow::cli_tests {
namespace {
using nlohmann::json;

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
  // Pictures of all papers come about in one way: some of each are enough.
  const std::vector<Offer> offers = offersOf(page);
  ASSERT_GE(offers.size(), 20u);
  for (std::size_t i = 0; i < offers.size(); i += 10)
    expectSameVisibility(offers[i].visibility, readImage(play(offers[i].command, folder_)),
                         offers[i].command);
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

TEST_F(CliTest, ReportsCommandsMakeItsPictures) {
  const std::string stem = "figure_light_0_8", source = "builtin:figure@light=0.8";
  const ProcessResult result = run({"report", source, "-o", path("out"), "-t", "hard,pcf,occlusion-textures",
                                    "--size", "96x72", "--samples", "4", "--frames", "0", "--set",
                                    "map_size=256", "--set", "pcf.size=13", "--force", "depth-texture=off"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const std::vector<Offer> offers = offersOf(textOf(path("out/report.html")));
  ASSERT_EQ(offers.size(), 4u);  // the shaded picture and three techniques
  for (const Offer& offer : offers) {
    const images::FloatImage made = readImage(play(offer.command, folder_));
    // The viewer's line says the same up to what is written.
    const std::string view = offer.command.substr(0, offer.command.find(" --size"));
    EXPECT_EQ("halfshadow-viewer" + view.substr(std::string("halfshadow render").size()),
              offer.inViewer.substr(0, offer.inViewer.find(" --size")));
    if (!offer.visibility.pixels.empty()) {
      expectSameVisibility(offer.visibility, made, offer.command);
      continue;
    }
    const std::size_t first = offer.command.find("-t ") + 3;
    const std::string id = offer.command.substr(first, offer.command.find(' ', first) - first);
    const images::FloatImage saved = readImage(path("out/" + stem + "-" + id + ".png"));
    ASSERT_EQ(saved.channels, 4);
    for (std::size_t i = 0; i < made.pixels.size(); ++i)
      ASSERT_EQ(made.pixels[i], saved.pixels[i / 3 * 4 + i % 3]) << offer.command << " at byte " << i;
  }
}

TEST_F(CliTest, ReportWithoutScenesAndPapersIsBadUsage) {
  expectFailure({"report", "-o", path("out")}, 2, {"--papers"});
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace halfshadow::cli_tests
