// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "profile/compiled_counts.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "shipped/profiles.hpp"

namespace halfshadow::profile {
namespace {
using nlohmann::json;

bool isListOfObjects(const json& file, const char* key) {
  return file.contains(key) && file[key].is_array() &&
         std::ranges::all_of(file[key], [](const json& entry) { return entry.is_object(); });
}

bool isCounts(const json& file) {
  return file.is_object() && file.contains("note") && file["note"].is_string() &&
         isListOfObjects(file, "columns") && isListOfObjects(file, "counts");
}

bool profiles(const Suite& suite, const std::string& technique) {
  return std::ranges::any_of(suite.configurations, [&](const SuiteConfiguration& configuration) {
    return configuration.configuration.technique == technique;
  });
}
}  // namespace

Result<CompiledCounts> compiledCounts(const Suite& suite) {
  const shipped::File* shipped = shipped::profile("compiled/mobile.json");
  if (!shipped) return CompiledCounts{};
  const json file = json::parse(shipped->text, nullptr, false);
  if (!isCounts(file)) {
    return Error{ErrorCode::fileMalformed,
                 std::string(shipped->path) +
                     ": not what tests/mobile/compile.py --write gives; write it anew, or remove it"};
  }
  CompiledCounts counts{.note = file["note"], .header = {"compiled", "pixel"}, .rows = {}};
  for (const json& column : file["columns"]) counts.header.push_back(column.value("title", ""));
  for (const json& entry : file["counts"]) {
    const std::string technique = entry.value("technique", "");
    if (!profiles(suite, technique)) continue;
    std::string pixel = entry.value("path", "");
    if (const std::string receivers = entry.value("receivers", ""); receivers == "casting")
      pixel += ", casting";
    std::vector<std::string> row = {technique, pixel};
    const json cells = entry.value("counts", json::object());
    for (const json& column : file["columns"]) row.push_back(cells.value(column.value("gpu", ""), "-"));
    counts.rows.push_back(std::move(row));
  }
  return counts;
}

}  // namespace halfshadow::profile
