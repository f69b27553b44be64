// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "json.hpp"

#include <cstdio>

#include "measure/text_file.hpp"

namespace halfshadow::cli {
namespace {
Status named(const Status& status) {
  return status ? Status{} : Status(Error{status.error().code, "--json: " + status.error().message});
}
}  // namespace

bool printsText(const std::string& jsonPath) {
  return jsonPath != "-";
}

Status checkJsonPath(const std::string& jsonPath) {
  const bool stream = jsonPath == "-" || measure::isSpecial(jsonPath);
  return jsonPath.empty() || stream ? Status{} : named(measure::checkWritable(jsonPath));
}

Status writeJson(const std::string& jsonPath, const Json& json) {
  if (jsonPath.empty()) return {};
  // Names in scene files need not be UTF-8: replace what is not, rather than fail after the work.
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (jsonPath == "-") {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return {};  // main checks standard output once, at the end
  }
  return named(measure::writeTextFile(jsonPath, text));
}

}  // namespace halfshadow::cli
