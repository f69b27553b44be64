// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The cases themselves: complete, reproducible, and what their rule says of them is true of the ray tracer.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <set>

#include "stress/table.hpp"

namespace halfshadow::stress {
namespace {

bool sameScene(const scene::SceneDescription& a, const scene::SceneDescription& b) {
  if (a.objects.size() != b.objects.size() || a.lights.front().centerWorld != b.lights.front().centerWorld ||
      a.camera->eyeWorld != b.camera->eyeWorld) {
    return false;
  }
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    if (a.objects[i].mesh->positions != b.objects[i].mesh->positions ||
        a.objects[i].mesh->indices != b.objects[i].mesh->indices ||
        a.objects[i].worldFromObject != b.objects[i].worldFromObject)
      return false;
  }
  return true;
}

TEST(StressCases, AreCompleteAndReproducible) {
  std::set<std::string> names;
  for (const Case& c : cases()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name << " twice";
    EXPECT_FALSE(c.what.empty());
    EXPECT_FALSE(ruleText(c.rule).empty());
    const auto variants = c.make(7), again = c.make(7);
    ASSERT_FALSE(variants.empty()) << c.name;
    ASSERT_EQ(variants.size(), again.size());
    std::set<std::string> scenes;
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const Variant& v = variants[i];
      EXPECT_TRUE(scenes.insert(v.name).second) << c.name << ": " << v.name << " twice";
      EXPECT_TRUE(sameScene(v.scene, again[i].scene)) << c.name << " " << v.name;
      ASSERT_TRUE(v.scene.camera.has_value());
      EXPECT_TRUE(scene::checkCamera(*v.scene.camera).ok()) << c.name << " " << v.name;
      ASSERT_EQ(v.scene.lights.size(), 1u);
      EXPECT_EQ(c.rule == Rule::steady, !v.frames.empty());
      if (sharesTruth(c.rule) || c.rule == Rule::own) {
        EXPECT_FALSE(baseScene(v.base).objects.empty()) << c.name << " " << v.name;
      }
    }
  }
}

TEST(StressCases, AreFoundByTheBeginningOfTheirNames) {
  const auto lights = chosenCases({"light-", "scale"});
  ASSERT_TRUE(lights);
  EXPECT_GE(lights->size(), 4u);
  EXPECT_EQ(lights->front().name, "scale") << "in the order of tables";
  const auto unknown = chosenCases({"earthquake"});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::invalidArgument);
  EXPECT_NE(unknown.error().message.find("lamp-post"), std::string::npos);
  EXPECT_EQ(chosenCases({})->size(), cases().size());
}

// The truth owes nothing to what else the scene holds, to its size, its place, or the order of its triangles;
// and closed rooms are dark. Judged as every technique is: another seed, and the base's own noise.
TEST(StressCases, RayTracerPassesThemAll) {
  auto session = measure::EngineSession::open({.driver = "llvmpipe", .deviceProfile = "none"});
  ASSERT_TRUE(session) << session.error().message;
  const Options options{.width = 64, .height = 48, .samples = 100, .seed = 20261};
  std::printf("seed %llu\n", static_cast<unsigned long long>(options.seed));
  std::vector<Case> asked;
  for (const Case& c : cases()) {
    if (sharesTruth(c.rule) || c.rule == Rule::dark || c.rule == Rule::lit) asked.push_back(c);
  }
  const auto table = run(**session, asked, {}, options);
  ASSERT_TRUE(table) << table.error().message;
  for (const CaseResult& c : table->cases) {
    ASSERT_EQ(c.cells.size(), 1u);
    EXPECT_EQ(c.cells.front().variants.size(), c.variants.size()) << c.name;
  }
  for (const std::string& line : remarks(*table)) ADD_FAILURE() << line;
}

TEST(StressTable, ShowsTheGravestVerdictAndSaysWhy) {
  Table table{.techniques = {"hard", "pcf-masked", kReferenceColumn}, .cases = {}};
  CaseResult c{.name = "flood", .what = "water", .rule = Rule::own, .variants = {"low", "high"}, .cells = {}};
  c.cells.push_back({"hard", {{.variant = "low"}, {.variant = "high"}}});
  c.cells.push_back({"pcf-masked",
                     {{.variant = "low", .judgement = {Verdict::wrong, "all lit"}},
                      {.variant = "high", .judgement = {Verdict::worse, "half lit"}}}});
  c.cells.push_back({kReferenceColumn, {}});
  table.cases.push_back(c);
  const auto rows = summaryRows(table);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"", "", "pcf-", ""}));
  EXPECT_EQ(rows[1], (std::vector<std::string>{"", "hard", "masked", "reference"}));
  EXPECT_EQ(rows[2], (std::vector<std::string>{"flood", "ok", "WRONG", "-"}));
  EXPECT_EQ(remarks(table), (std::vector<std::string>{"flood/low pcf-masked: WRONG: all lit",
                                                      "flood/high pcf-masked: worse: half lit"}));
  EXPECT_EQ(countsText(table), "1 ok, 0 fell back, 0 refused, 0 worse, 1 WRONG");
  const auto json = toJson(table, {}, {.vendor = "v", .renderer = "r", .version = "1"});
  EXPECT_EQ(json["counts"]["WRONG"], 1);
  EXPECT_EQ(json["cases"][0]["cells"].size(), 2u) << "the reference was asked nothing";
  EXPECT_EQ(json["cases"][0]["cells"][1]["variants"][0]["reason"], "all lit");
}

TEST(StressMeasurement, ATechniqueThatFailsIsARow) {
  measure::TechniqueMeasurement failed{.id = "hard", .failure = "the lists are too long; lower tiles"};
  EXPECT_FALSE(failed.measured());
  EXPECT_EQ(failed.absence(), "failed: the lists are too long; lower tiles");
  const measure::Json json = measure::toJson(failed);
  EXPECT_EQ(json["supported"], true);
  EXPECT_EQ(json["failed"], failed.failure);
  EXPECT_FALSE(json.contains("error"));
  failed.failure.clear();
  EXPECT_TRUE(failed.measured());
  EXPECT_TRUE(failed.absence().empty());
}

}  // namespace
}  // namespace halfshadow::stress
