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

Json limitsJson(const DriverRecord& driver) {
  return {{"texture_size", driver.maxTextureSize},
          {"renderbuffer_size", driver.maxRenderbufferSize},
          {"vertex_attributes", driver.maxVertexAttributes},
          {"varying_vectors", driver.maxVaryingVectors},
          {"vertex_uniform_vectors", driver.maxVertexUniformVectors},
          {"fragment_uniform_vectors", driver.maxFragmentUniformVectors},
          {"vertex_texture_units", driver.maxVertexTextureUnits},
          {"fragment_texture_units", driver.maxFragmentTextureUnits}};
}

Json infoJson(measure::EngineSession& session) {
  Engine& engine = session.engine();
  const DriverRecord driver = engine.driver();
  Json json{{"driver", measure::driverJson(driver)}, {"context", session.contextDescription()}};
  json["driver"]["shading_language"] = driver.shadingLanguageVersion;
  json["limits"] = limitsJson(driver);
  json["rungs"] = {{"depth_storage", driver.depthStorage},
                   {"byte_rounding", driver.byteRounding},
                   {"highp_mantissa_bits", driver.highpMantissaBits},
                   {"mediump_mantissa_bits", driver.mediumpMantissaBits}};
  json["capabilities"] = Json::array();
  for (std::size_t i = 0; i < engine.capabilityCount(); ++i) {
    const CapabilityRecord capability = engine.capability(i);
    json["capabilities"].push_back({{"name", capability.name},
                                    {"available", capability.available},
                                    {"reason", capability.reason},
                                    {"text", capability.text}});
  }
  json["extensions"] = Json::array();
  for (std::size_t i = 0; i < engine.extensionCount(); ++i) json["extensions"].push_back(engine.extension(i));
  return json;
}

std::string shortText(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void printSection(const char* title, const Json& object) {
  std::printf("%s\n", title);
  TextTable table{.leftAligned = {0, 1}};
  for (const auto& [key, value] : object.items()) table.rows.push_back({"  " + key, shortText(value)});
  print(table);
}

void printInfo(const Json& json) {
  printSection("driver", json["driver"]);
  std::printf("  opened with       %s\n", json["context"].get<std::string>().c_str());
  printSection("limits", json["limits"]);
  printSection("chosen rungs", json["rungs"]);
  std::printf("capabilities\n");
  TextTable table{.leftAligned = {0, 1, 2}};
  for (const Json& capability : json["capabilities"]) {
    const bool available = capability["available"];
    table.rows.push_back({"  " + shortText(capability["name"]), available ? "yes" : "no",
                          shortText(available ? capability["text"] : capability["reason"])});
  }
  print(table);
  std::printf("extensions (%zu)\n", json["extensions"].size());
  for (const Json& extension : json["extensions"]) std::printf("  %s\n", shortText(extension).c_str());
}

ExitStatus info(const Arguments& arguments) {
  if (Status status = checkJsonPath(arguments.json); !status) return fail(status.error());
  auto session = openSession(arguments.driver);
  if (!session) return fail(session.error());
  const Json json = infoJson(**session);
  if (printsText(arguments.json)) printInfo(json);
  const Status written = writeJson(arguments.json, json);
  return written ? kDone : fail(written.error());
}
}  // namespace

void addInfoCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("info", "driver, limits, capabilities with reasons, chosen rungs");
  addDriverArguments(*command, arguments->driver);
  addJsonArgument(*command, arguments->json);
  command->callback([arguments, &status] { status = info(*arguments); });
}

}  // namespace halfshadow::cli
