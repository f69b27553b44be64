// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cstdio>

#include "commands.hpp"
#include "json.hpp"
#include "options.hpp"
#include "scenes/builtin_scenes.hpp"
#include "text_table.hpp"

namespace halfshadow::cli {
namespace {
ExitStatus listScenes(const std::string& jsonPath) {
  if (Status status = checkJsonPath(jsonPath); !status) return fail(status.error());
  Json json{{"scenes", Json::array()}};
  TextTable table{.header = {"scene", "triangles", "description"}, .leftAligned = {0, 2}};
  for (const scenes::BuiltinInfo& info : scenes::builtinScenes()) {
    const std::uint64_t triangles = info.triangleCount();
    const std::string source = "builtin:" + info.name;
    json["scenes"].push_back({{"name", info.name},
                              {"source", source},
                              {"description", info.description},
                              {"triangles", triangles}});
    table.rows.push_back({source, std::to_string(triangles), info.description});
  }
  if (printsText(jsonPath)) {
    print(table);
    std::printf(
        "\nbuiltin:NAME@key=value,key=value changes a scene: light = half size of the light in world units "
        "(0 is a\n"
        "point), scale = factor about the origin, shift = distance along x and z.\n");
  }
  const Status written = writeJson(jsonPath, json);
  return written ? kDone : fail(written.error());
}
}  // namespace

void addScenesCommand(CLI::App& app, ExitStatus& status) {
  const auto jsonPath = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("scenes", "the built-in scenes");
  addJsonArgument(*command, *jsonPath);
  command->callback([jsonPath, &status] { status = listScenes(*jsonPath); });
}

}  // namespace halfshadow::cli
