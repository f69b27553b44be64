// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cstdio>

#include "commands.hpp"
#include "json.hpp"
#include "options.hpp"
#include "text_table.hpp"

namespace halfshadow::cli {
namespace {
struct Arguments {
  DriverArguments driver;
  std::string json;
};

Json settingJson(const SettingRecord& setting) {
  return {{"key", setting.key},
          {"type", setting.type},
          {"default", setting.defaultValue},
          {"allowed", setting.allowed},
          {"text", setting.text}};
}

/// Settings whose key starts with "<prefix>.", or has no dot when `prefix` is empty.
Json settingsJson(Engine& engine, const std::string& prefix) {
  Json json = Json::array();
  for (std::size_t i = 0; i < engine.settingCount(); ++i) {
    const SettingRecord setting = engine.setting(i);
    const std::string key = setting.key;
    const std::size_t dot = key.find('.');
    if ((dot == std::string::npos ? "" : key.substr(0, dot)) == prefix) json.push_back(settingJson(setting));
  }
  return json;
}

Json techniquesJson(measure::EngineSession& session) {
  Engine& engine = session.engine();
  Json json{{"driver", measure::driverJson(engine.driver())}};
  json["techniques"] = Json::array();
  for (std::size_t i = 0; i < engine.techniqueCount(); ++i) {
    const TechniqueRecord technique = engine.technique(i);
    Json entry{{"id", technique.id},
               {"paper", technique.paper},
               {"summary", technique.summary},
               {"guarantees", technique.guarantees},
               {"known_failures", technique.knownFailures},
               {"supported", technique.supported},
               {"reason", technique.unsupportedReason}};
    entry["settings"] = settingsJson(engine, technique.id);
    json["techniques"].push_back(std::move(entry));
  }
  json["shared_settings"] = settingsJson(engine, "");
  return json;
}

void printField(const char* label, const Json& value) {
  const std::string text = value;
  if (!text.empty()) std::printf("  %-12s %s\n", label, text.c_str());
}

void printSettings(const Json& settings) {
  TextTable table{.leftAligned = {0, 1, 2}};
  for (const Json& setting : settings) {
    table.rows.push_back(
        {"    " + setting["key"].get<std::string>() + "=" + setting["default"].get<std::string>(),
         setting["allowed"], setting["text"]});
  }
  print(table);
}

void printTechniques(const Json& json) {
  for (const Json& technique : json["techniques"]) {
    const std::string reason = technique["reason"];
    std::printf("%s%s\n", technique["id"].get<std::string>().c_str(),
                technique["supported"] ? "" : ("  [not supported here: " + reason + "]").c_str());
    printField("", technique["summary"]);
    printField("paper", technique["paper"]);
    printField("guarantees", technique["guarantees"]);
    printField("fails when", technique["known_failures"]);
    printSettings(technique["settings"]);
  }
  std::printf("settings of all techniques that use them\n");
  printSettings(json["shared_settings"]);
}

ExitStatus techniques(const Arguments& arguments) {
  if (Status status = checkJsonPath(arguments.json); !status) return fail(status.error());
  auto session = openSession(arguments.driver);
  if (!session) return fail(session.error());
  const Json json = techniquesJson(**session);
  if (printsText(arguments.json)) printTechniques(json);
  const Status written = writeJson(arguments.json, json);
  return written ? kDone : fail(written.error());
}
}  // namespace

void addTechniquesCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "techniques", "the shadow techniques: paper, settings with defaults, supported here or why not");
  addDriverArguments(*command, arguments->driver);
  addJsonArgument(*command, arguments->json);
  command->callback([arguments, &status] { status = techniques(*arguments); });
}

}  // namespace halfshadow::cli
