// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every technique of the registry in one scene of each case, chosen by a seed that is printed.
// HALFSHADOW_TEST_SEED chooses another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "stress/table.hpp"

namespace halfshadow::stress {
namespace {

std::uint64_t testSeed() {
  const char* text = std::getenv("HALFSHADOW_TEST_SEED");
  return text ? std::strtoull(text, nullptr, 10) : 20261;
}

measure::EngineSession* session() {
  static const auto opened = [] {
    const char* driver = std::getenv("HALFSHADOW_TEST_DRIVER");
    return measure::EngineSession::open({.driver = driver ? driver : "llvmpipe", .deviceProfile = "none"});
  }();
  EXPECT_TRUE(opened) << opened.error().message;
  return opened ? opened->get() : nullptr;
}

class Stress : public testing::TestWithParam<std::string> {};

TEST_P(Stress, NoTechniqueIsWrong) {
  ASSERT_NE(session(), nullptr);
  const auto asked = chosenCases({GetParam()});
  ASSERT_TRUE(asked);
  const std::filesystem::path folder = std::filesystem::path(HALFSHADOW_TEST_OUTPUT_DIR);
  std::filesystem::create_directories(folder);
  const Options options{.width = 64,
                        .height = 48,
                        .samples = 100,
                        .seed = testSeed(),
                        .variantsPerCase = 1,
                        .dumpFolder = folder};
  for (const Case& c : *asked) {
    if (c.name != GetParam()) continue;
    const auto table = run(*session(), {c}, shadowTechniques(*session()), options);
    ASSERT_TRUE(table) << table.error().message;
    std::printf("seed %llu: %s\n", static_cast<unsigned long long>(options.seed), countsText(*table).c_str());
    for (const Cell& cell : table->cases.front().cells) {
      for (const VariantResult& v : cell.variants) {
        // `worse` is a figure, not a fault; a scene that is the same may not even be that.
        const Verdict allowed = sharesTruth(c.rule) ? Verdict::refused : Verdict::worse;
        const std::string scene = c.name + "/" + v.variant;
        EXPECT_LE(v.judgement.verdict, allowed)
            << scene << " " << cell.technique << ": " << v.judgement.reason << "; see " << folder.string();
      }
    }
  }
}

// Walls reach from beside the lamp to the far end: whatever list holds their facets, all its places stay
// exact.
TEST(StressOfLists, EveryRoomAroundALamp) {
  ASSERT_NE(session(), nullptr);
  const auto asked = chosenCases({"lamp-room"});
  ASSERT_TRUE(asked);
  const auto table = run(*session(), *asked, {"wedges-blended", "wedges-cells"},
                         {.width = 64, .height = 48, .samples = 100, .seed = testSeed()});
  ASSERT_TRUE(table) << table.error().message;
  for (const Cell& cell : table->cases.front().cells) {
    if (cell.technique == kReferenceColumn) continue;
    EXPECT_EQ(cell.variants.size(), 5u) << cell.technique;
    for (const VariantResult& v : cell.variants)
      EXPECT_LE(v.judgement.verdict, Verdict::worse)
          << v.variant << " " << cell.technique << ": " << v.judgement.reason;
  }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Case& c : cases()) all.push_back(c.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Techniques, Stress, testing::ValuesIn(names()), [](const auto& tested) {
  std::string name = tested.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace halfshadow::stress
