// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Rules that hold for every file.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <regex>
#include <set>

#include "source_tree.hpp"

namespace halfshadow::architecture {
namespace {

std::string at(const SourceFile& file, std::size_t line) {
  return file.path + ":" + std::to_string(line + 1);
}

TEST(SourceRules, FilesAreShort) {
  // STYLE: reviewed at 500 lines, split at 800.
  constexpr std::size_t kLongest = 800;
  for (const SourceFile& file : sourceTree()) {
    EXPECT_LE(linesOf(file.text).size(), kLongest) << file.path << ": split it";
  }
}

TEST(SourceRules, EverySourceStartsWithItsLicence) {
  int checked = 0;
  for (const SourceFile& file : sourceTree()) {
    const bool script =
        file.path.ends_with(".sh") || file.path.ends_with(".cmake") || file.path.ends_with("CMakeLists.txt");
    if (!isCpp(file) && !isShader(file) && !script) continue;
    const std::vector<std::string> lines = linesOf(file.text);
    ++checked;
    std::string head;
    for (std::size_t i = 0; i < std::min<std::size_t>(3, lines.size()); ++i) head += lines[i] + '\n';
    EXPECT_NE(head.find("SPDX-License-Identifier: MIT"), std::string::npos) << file.path;
    if (!isCpp(file)) continue;
    EXPECT_NE(head.find("Copyright (c) 2026 The Halfshadow authors"), std::string::npos) << file.path;
  }
  EXPECT_GT(checked, 100);
}

TEST(SourceRules, NothingIsLeftForLaterAndNoMachineIsNamed) {
  // Written in pieces, so that this file does not find itself.
  const std::regex kLater(std::string("\\b(TO") + "DO|FIX" + "ME|XX" + "X)\\b");
  const std::regex kMachine(std::string("(^|[\\s\"'=(])/(wor") + "k|ho" + "me|ro" + "ot|tm" + "p|Use" +
                            "rs)/");
  for (const SourceFile& file : sourceTree()) {
    const std::vector<std::string> lines = linesOf(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_FALSE(std::regex_search(lines[i], kLater)) << at(file, i) << ": do it or drop it: " << lines[i];
      EXPECT_FALSE(std::regex_search(lines[i], kMachine))
          << at(file, i) << ": a path of one machine: " << lines[i];
    }
  }
}

TEST(SourceRules, TextIsClean) {
  for (const SourceFile& file : sourceTree()) {
    EXPECT_TRUE(file.text.empty() || file.text.back() == '\n') << file.path << ": no line break at its end";
    EXPECT_EQ(file.text.find('\r'), std::string::npos) << file.path << ": carriage return";
    const std::vector<std::string> lines = linesOf(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_EQ(lines[i].find('\t'), std::string::npos) << at(file, i) << ": tab";
      EXPECT_FALSE(lines[i].ends_with(' ')) << at(file, i) << ": space at the line's end";
    }
  }
}

TEST(SourceRules, OnlyTheGlModuleTouchesTheDriver) {
  // By entry point (glClear) or by member of the function table (gl.clear, gl->clear): in the rest of the
  // engine a draw, a clear or a bind would escape the encoder's counters and the host-state guard.
  const std::regex kEntryPoint(
      "\\bgl(Draw|Clear|Bind|Tex|Buffer|Enable|Disable|Viewport|Use|Read|Framebuffer)[A-Z]?\\w*\\s*\\(");
  const std::regex kTable("(functions\\(\\)|\\bgl)\\s*(\\.|->)(draw\\w+|clear\\w*|bind\\w+|readPixels)\\(");
  int checked = 0;
  for (const SourceFile& file : sourceTree()) {
    if (!file.path.starts_with("engine/") || file.path.starts_with("engine/gl/") || !isCpp(file)) continue;
    ++checked;
    const std::vector<std::string> lines = linesOf(withoutComments(file.text));
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_FALSE(std::regex_search(lines[i], kEntryPoint)) << at(file, i) << ": " << lines[i];
      EXPECT_FALSE(std::regex_search(lines[i], kTable)) << at(file, i) << ": " << lines[i];
    }
  }
  EXPECT_GT(checked, 50);
}

// One service of each light extracts silhouettes, so that none is extracted twice.
TEST(SourceRules, SilhouettesAreExtractedInOnePlace) {
  const std::regex kExtracts("\\b(extractSilhouette|lightSilhouettes)\\s*\\(");
  int services = 0;
  for (const SourceFile& file : sourceTree()) {
    if (!file.path.starts_with("engine/") || !isCpp(file)) continue;
    const bool extracts = std::regex_search(withoutComments(file.text), kExtracts);
    services += extracts && file.path == "engine/scene/caster_silhouettes.cpp";
    if (!file.path.starts_with("engine/scene/"))
      EXPECT_FALSE(extracts) << file.path << ": take them from LightScene::silhouettes";
  }
  EXPECT_EQ(services, 1);
}

TEST(SourceRules, HeadersAreGuarded) {
  for (const SourceFile& file : sourceTree()) {
    if (file.path.ends_with(".hpp")) {
      EXPECT_NE(file.text.find("#pragma once"), std::string::npos) << file.path;
    } else if (file.path.ends_with(".h")) {
      EXPECT_NE(file.text.find("#ifndef HALFSHADOW_"), std::string::npos)
          << file.path << ": C headers have guards";
    }
  }
}

TEST(SourceRules, CppIsFormatted) {
  const std::string clangFormat = HALFSHADOW_CLANG_FORMAT;
  if (clangFormat.empty()) GTEST_SKIP() << "clang-format was not found when CMake ran; install clang-format";
  std::string command = "cd '" HALFSHADOW_SOURCE_DIR "' && '" + clangFormat + "' --dry-run -Werror";
  for (const SourceFile& file : sourceTree()) {
    if (isCpp(file)) command += " '" + file.path + "'";
  }
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string output;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) output += buffer;
  const int status = pclose(pipe);
  std::set<std::string> unformatted;
  for (const std::string& line : linesOf(output)) {
    if (line.find(": error: ") != std::string::npos) unformatted.insert(line.substr(0, line.find(':')));
  }
  std::string names;
  for (const std::string& name : unformatted) names += " " + name;
  EXPECT_EQ(status, 0) << "run: clang-format -i" << (names.empty() ? output : names);
}

}  // namespace
}  // namespace halfshadow::architecture
