// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "profile/suite.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace halfshadow::profile {
namespace {

Error malformed(const std::string& file, const std::string& text) {
  return {ErrorCode::fileMalformed, file + ": " + text + "; see profiles/benchmarks/quick.json for the form"};
}

bool hasLabel(const Suite& suite, const std::string& label) {
  return std::ranges::any_of(suite.configurations, [&](const auto& c) { return c.label == label; });
}

/// Throws nlohmann's exceptions for missing fields and wrong types.
Suite suiteOf(const nlohmann::json& json) {
  Suite suite;
  suite.name = json.at("name").get<std::string>();
  suite.description = json.at("description").get<std::string>();
  suite.width = json.at("size").at(0).get<int>();
  suite.height = json.at("size").at(1).get<int>();
  suite.samples = json.at("samples").get<int>();
  suite.repetitions = json.at("repetitions").get<int>();
  suite.scenes = json.at("scenes").get<std::vector<std::string>>();
  for (const auto& entry : json.at("configurations")) {
    SuiteConfiguration configuration;
    configuration.configuration.technique = entry.at("technique").get<std::string>();
    configuration.label = entry.value("label", configuration.configuration.technique);
    if (entry.contains("settings")) {
      for (const auto& [key, value] : entry.at("settings").items()) {
        configuration.configuration.settings.push_back({key, value.get<std::string>()});
      }
    }
    suite.configurations.push_back(std::move(configuration));
  }
  if (json.contains("ratios")) {
    for (const auto& entry : json.at("ratios")) {
      suite.ratios.push_back({entry.at("of").get<std::string>(), entry.at("to").get<std::string>()});
    }
  }
  return suite;
}

}  // namespace

Result<Suite> readSuite(const std::string& nameOrFile) {
  std::filesystem::path path(nameOrFile);
  if (!nameOrFile.ends_with(".json"))
    path = std::filesystem::path(HALFSHADOW_SUITE_DIR) / (nameOrFile + ".json");
  const std::string file = path.string();
  std::ifstream stream(path);
  if (!stream) {
    return Error{ErrorCode::fileNotFound,
                 file + ": cannot be read; give a suite's .json file, or quick or evans"};
  }
  Suite suite;
  try {
    suite = suiteOf(nlohmann::json::parse(stream));
  } catch (const std::exception& error) {
    return malformed(file, error.what());
  }
  if (suite.width < 1 || suite.height < 1) return malformed(file, "\"size\" must be two positive numbers");
  if (suite.samples < 1 || suite.repetitions < 1) {
    return malformed(file, "\"samples\" and \"repetitions\" must be at least 1");
  }
  if (suite.scenes.empty() || suite.configurations.empty()) {
    return malformed(file, "\"scenes\" and \"configurations\" must not be empty");
  }
  for (const Ratio& ratio : suite.ratios) {
    for (const std::string& label : {ratio.of, ratio.to}) {
      if (!hasLabel(suite, label))
        return malformed(file, "\"ratios\" name \"" + label + "\", which no label is");
    }
  }
  return suite;
}

}  // namespace halfshadow::profile
