// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The arrows of the architecture, read from the include lines: who may know whom.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "source_tree.hpp"

namespace halfshadow::architecture {
namespace {

using Names = std::set<std::string>;

struct Include {
  std::string file;    ///< that includes
  std::string target;  ///< between quotes or angle brackets
  bool quoted = false;
  int line = 0;
};

std::vector<Include> includesOf(const SourceFile& file) {
  std::vector<Include> includes;
  int number = 0;
  for (const std::string& line : linesOf(file.text)) {
    ++number;
    const std::size_t hash = line.find_first_not_of(' ');
    if (hash == std::string::npos || line.compare(hash, 8, "#include") != 0) continue;
    const std::size_t open = line.find_first_of("\"<", hash);
    if (open == std::string::npos) continue;
    const std::size_t close = line.find_first_of("\">", open + 1);
    if (close == std::string::npos) continue;
    includes.push_back({file.path, line.substr(open + 1, close - open - 1), line[open] == '"', number});
  }
  return includes;
}

/// "engine/gl/buffer.cpp" → "gl"; empty for files directly in the folder.
std::string moduleOf(const std::string& path, const std::string& folder) {
  const std::size_t end = path.find('/', folder.size());
  return end == std::string::npos ? "" : path.substr(folder.size(), end - folder.size());
}

std::string where(const Include& include) {
  return include.file + ":" + std::to_string(include.line);
}

TEST(IncludeArrows, EngineModulesKnowOnlyWhatLiesBelowThem) {
  // In an order in which each names only earlier ones, so that there can be no cycle.
  const std::vector<std::pair<std::string, Names>> kMayInclude = {
      {"base", {}},
      {"device", {"base"}},
      {"scene", {"base"}},
      {"outlines", {"base", "scene"}},
      {"gl", {"base", "device"}},
      {"framegraph", {"base", "gl"}},
      {"planner", {"base", "scene"}},
      {"techniques", {"base", "device", "scene", "outlines", "gl", "framegraph", "planner"}},
      {"api", {"base", "device", "scene", "gl", "framegraph", "planner", "techniques"}},
      {"metrics", {"base"}},
      {"reference", {"base", "scene"}},
  };
  std::map<std::string, Names> allowed;
  Names earlier;
  for (const auto& [module, names] : kMayInclude) {
    for (const std::string& name : names) {
      EXPECT_TRUE(earlier.count(name)) << module << " may not name " << name << ", which comes later";
    }
    allowed[module] = names;
    allowed[module].insert({module, "halfshadow"});
    earlier.insert(module);
  }
  int checked = 0;
  for (const SourceFile& file : sourceTree()) {
    if (!file.path.starts_with("engine/") || !isCpp(file) || file.path.starts_with("engine/include/"))
      continue;
    const std::string module = moduleOf(file.path, "engine/");
    ASSERT_TRUE(allowed.count(module)) << file.path << ": add the new module to the table";
    for (const Include& include : includesOf(file)) {
      if (!include.quoted || include.target.find('/') == std::string::npos) continue;
      ++checked;
      EXPECT_TRUE(allowed[module].count(moduleOf(include.target, "")))
          << where(include) << ": " << module << " must not include \"" << include.target << "\"";
    }
  }
  EXPECT_GT(checked, 100) << "the engine has hundreds of include lines: were they found?";
}

TEST(IncludeArrows, ThePlanOfAFrameKnowsNoGl) {
  // The executor is the only part of the frame graph that draws.
  const Names kExecutor = {"engine/framegraph/executor.hpp", "engine/framegraph/executor.cpp",
                           "engine/framegraph/resource_pool.hpp", "engine/framegraph/resource_pool.cpp"};
  int executorUsesGl = 0;
  for (const SourceFile& file : sourceTree()) {
    if (!file.path.starts_with("engine/framegraph/") || !isCpp(file)) continue;
    for (const Include& include : includesOf(file)) {
      const bool usesGl = include.target.starts_with("gl/");
      if (kExecutor.count(file.path)) {
        executorUsesGl += usesGl ? 1 : 0;
      } else {
        EXPECT_FALSE(usesGl) << where(include) << ": the plan must stay testable without a GPU";
      }
    }
  }
  EXPECT_GT(executorUsesGl, 0);
}

TEST(IncludeArrows, TechniquesDoNotKnowEachOther) {
  // `core` is what a technique is and gets, `parts` what several share; `registry` lists the techniques and
  // is known to none of them.
  const Names kShared = {"core", "parts", "execution"};
  int checked = 0;
  for (const SourceFile& file : sourceTree()) {
    if (!file.path.starts_with("engine/techniques/") || !isCpp(file)) continue;
    const std::string own = moduleOf(file.path, "engine/techniques/");
    if (own == "registry") continue;
    for (const Include& include : includesOf(file)) {
      if (!include.target.starts_with("techniques/")) continue;
      const std::string other = moduleOf(include.target, "techniques/");
      ++checked;
      EXPECT_TRUE(other == own || kShared.count(other))
          << where(include) << ": " << own << " must not include the technique " << other;
    }
  }
  EXPECT_GT(checked, 20);
}

TEST(IncludeArrows, PublicHeadersAreAloneWithTheLanguage) {
  const Names kLanguage = {"cstddef", "cstdint", "stddef.h", "stdint.h"};
  int headers = 0;
  for (const SourceFile& file : sourceTree()) {
    if (!file.path.starts_with("engine/include/") || !isCpp(file)) continue;
    ++headers;
    for (const Include& include : includesOf(file)) {
      EXPECT_TRUE(include.quoted ? include.target.starts_with("halfshadow/")
                                 : kLanguage.count(include.target) != 0)
          << where(include) << ": a public header includes " << include.target;
    }
  }
  EXPECT_GE(headers, 3);
}

TEST(IncludeArrows, DemosAndPlatformStayOutsideTheEngine) {
  // What the demos may know besides the public headers: CPU-only modules for files, truth and errors.
  const Names kForbidden = {"gl", "framegraph", "planner", "techniques", "api"};
  for (const SourceFile& file : sourceTree()) {
    const bool demo = file.path.starts_with("demos/"), platform = file.path.starts_with("platform/");
    if ((!demo && !platform) || !isCpp(file)) continue;
    for (const Include& include : includesOf(file)) {
      if (!include.quoted) continue;
      const std::string target = moduleOf(include.target, "");
      EXPECT_FALSE(kForbidden.count(target)) << where(include) << ": use the public headers";
      if (platform) {
        EXPECT_TRUE(target != "scene" && target != "scenes" && target != "measure") << where(include);
      }
    }
  }
}

TEST(IncludeArrows, ThirdPartyLibrariesHaveOneHome) {
  struct Home {
    std::string header, folder;
  };
  const std::vector<Home> kHomes = {{"embree3/", "engine/reference/"},
                                    {"OpenImageIO/", "platform/images/"},
                                    {"tiny_gltf.h", "demos/scenes/"},
                                    {"GLFW/", "platform/window/"},
                                    {"CLI/", "demos/"}};
  std::set<std::string> seen;
  for (const SourceFile& file : sourceTree()) {
    if (!isCpp(file) || file.path.starts_with("tests/")) continue;
    for (const Include& include : includesOf(file)) {
      for (const Home& home : kHomes) {
        if (!include.target.starts_with(home.header)) continue;
        seen.insert(home.header);
        EXPECT_TRUE(file.path.starts_with(home.folder)) << where(include) << ": belongs to " << home.folder;
      }
      if (include.target.starts_with("EGL/") || include.target.starts_with("GLES2/")) {
        EXPECT_TRUE(file.path.starts_with("engine/gl/") || file.path.starts_with("platform/") ||
                    file.path.starts_with("demos/embed/") || file.path.starts_with("demos/viewer/") ||
                    file.path.starts_with("demos/web/"))
            << where(include) << ": only engine/gl and hosts talk to the driver";
      }
    }
  }
  EXPECT_EQ(seen.size(), kHomes.size()) << "a library of the table is no longer used: remove its line";
}

}  // namespace
}  // namespace halfshadow::architecture
