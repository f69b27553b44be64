// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "profile/suite.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "shipped/profiles.hpp"

namespace halfshadow::profile {
namespace {

constexpr const char* kFolder = "benchmarks";

Error malformed(const std::string& file, const std::string& text) {
  return {ErrorCode::fileMalformed, file + ": " + text + "; see profiles/benchmarks/quick.json for the form"};
}

template <typename Labelled>
bool hasLabel(const std::vector<Labelled>& list, const std::string& label) {
  return std::ranges::any_of(list, [&](const auto& entry) { return entry.label == label; });
}

/// The first label that a ratio names and nothing has; empty when all exist.
std::string missingLabel(const Suite& suite) {
  for (const Ratio& ratio : suite.ratios) {
    for (const std::string& label : {ratio.of, ratio.to}) {
      if (!hasLabel(suite.configurations, label)) return label;
    }
  }
  for (const SceneRatio& ratio : suite.sceneRatios) {
    if (!hasLabel(suite.configurations, ratio.configuration)) return ratio.configuration;
    if (!ratio.above.empty() && !hasLabel(suite.configurations, ratio.above)) return ratio.above;
    for (const std::string& label : {ratio.of, ratio.to}) {
      if (!hasLabel(suite.scenes, label)) return label;
    }
  }
  return {};
}

SuiteScene sceneOf(const nlohmann::json& json) {
  if (json.is_string()) return {.label = json.get<std::string>(), .source = json.get<std::string>()};
  const auto source = json.at("source").get<std::string>();
  return {.label = json.value("label", source), .source = source, .camera = json.value("camera", "")};
}

/// Throws where it is no whole number that an int holds.
int countOf(const nlohmann::json& json) {
  if (!json.is_number_integer()) throw std::out_of_range("a size or count is not a whole number");
  const auto value = json.get<double>();
  if (!(value >= 0.0 && value <= std::numeric_limits<int>::max()))
    throw std::out_of_range("a size or count is not from 0 to " +
                            std::to_string(std::numeric_limits<int>::max()));
  return static_cast<int>(value);
}

/// Throws nlohmann's exceptions for missing fields and wrong types.
Suite suiteOf(const nlohmann::json& json) {
  Suite suite;
  suite.name = json.at("name").get<std::string>();
  suite.description = json.at("description").get<std::string>();
  suite.width = countOf(json.at("size").at(0));
  suite.height = countOf(json.at("size").at(1));
  suite.samples = countOf(json.at("samples"));
  suite.repetitions = countOf(json.at("repetitions"));
  for (const auto& entry : json.at("scenes")) suite.scenes.push_back(sceneOf(entry));
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
  if (json.contains("scene_ratios")) {
    for (const auto& entry : json.at("scene_ratios")) {
      suite.sceneRatios.push_back({entry.at("configuration").get<std::string>(), entry.value("above", ""),
                                   entry.at("of").get<std::string>(), entry.at("to").get<std::string>()});
    }
  }
  return suite;
}

/// "evans, forest, ..."
std::string shippedNames() {
  std::string names;
  for (const shipped::File& file : shipped::profiles(kFolder)) {
    if (!names.empty()) names += ", ";
    names += std::filesystem::path(file.path).stem().string();
  }
  return names;
}

Result<std::string> textOf(const std::string& nameOrFile) {
  if (!nameOrFile.ends_with(".json")) {
    if (const shipped::File* file = shipped::profile(kFolder + ("/" + nameOrFile + ".json")))
      return std::string(file->text);
  }
  std::ifstream stream(nameOrFile);
  if (!stream) {
    return Error{ErrorCode::fileNotFound,
                 nameOrFile + ": cannot be read; give a suite's .json file, or one of " + shippedNames()};
  }
  return std::string{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

Result<Suite> readSuite(const std::string& nameOrFile) {
  const auto text = textOf(nameOrFile);
  if (!text) return text.error();
  const std::string& file = nameOrFile;
  Suite suite;
  try {
    suite = suiteOf(nlohmann::json::parse(*text));
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
  if (const std::string label = missingLabel(suite); !label.empty()) {
    return malformed(file, "its ratios name \"" + label + "\", which no label is");
  }
  return suite;
}

}  // namespace halfshadow::profile
