// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "source_tree.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

namespace halfshadow::architecture {
namespace {

namespace fs = std::filesystem;

bool isText(const fs::path& path) {
  static const std::set<std::string> kEndings = {".cpp", ".hpp",   ".c",    ".h",  ".vert", ".frag", ".glsl",
                                                 ".txt", ".cmake", ".json", ".sh", ".md",   ".js",   ".html"};
  return kEndings.count(path.extension().string()) != 0;
}

std::vector<SourceFile> readTree() {
  const fs::path root(HALFSHADOW_SOURCE_DIR);
  std::vector<fs::path> paths;
  for (const char* folder : {"engine", "platform", "demos", "shaders_es2", "tests", "profiles"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.is_regular_file() && isText(entry.path())) paths.push_back(entry.path());
    }
  }
  for (const auto& entry : fs::directory_iterator(root)) {
    if (entry.is_regular_file() && isText(entry.path())) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<SourceFile> files;
  for (const fs::path& path : paths) {
    std::ifstream stream(path, std::ios::binary);
    files.push_back({fs::relative(path, root).generic_string(),
                     std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>())});
  }
  return files;
}

bool endsInOneOf(const std::string& path, std::initializer_list<std::string_view> endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](std::string_view end) { return path.ends_with(end); });
}

}  // namespace

const std::vector<SourceFile>& sourceTree() {
  static const std::vector<SourceFile> files = readTree();
  return files;
}

bool isCpp(const SourceFile& file) {
  return endsInOneOf(file.path, {".cpp", ".hpp", ".c", ".h"});
}
bool isShader(const SourceFile& file) {
  return endsInOneOf(file.path, {".vert", ".frag", ".glsl"});
}

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string withoutComments(std::string_view text) {
  enum class Place { code, lineComment, blockComment, string } place = Place::code;
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view next = text.substr(i, 2);
    switch (place) {
      case Place::code:
        if (next == "//") place = Place::lineComment;
        if (next == "/*") place = Place::blockComment;
        if (text[i] == '"') place = Place::string;
        break;
      case Place::string:
        if (text[i] == '\\')
          result += text[i++];
        else if (text[i] == '"' || text[i] == '\n')
          place = Place::code;
        break;
      case Place::lineComment:
        if (text[i] == '\n') place = Place::code;
        break;
      case Place::blockComment:
        if (next == "*/") {
          ++i;
          place = Place::code;
          continue;
        }
        break;
    }
    const bool comment = place == Place::lineComment || place == Place::blockComment;
    if ((!comment || text[i] == '\n') && i < text.size()) result += text[i];
  }
  return result;
}

}  // namespace halfshadow::architecture
