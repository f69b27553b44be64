// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cstdio>
#include <exception>
#include <string>

#include "base/log.hpp"
#include "commands.hpp"

namespace halfshadow::cli {
namespace {
std::string usageProblem(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const auto chosen = app.get_subcommands();
  if (!chosen.empty())
    return std::string(error.what()) + "; see `halfshadow " + chosen.front()->get_name() + " --help`";
  std::string commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands += (commands.empty() ? "" : ", ") + command->get_name();
  }
  if (argc < 2) return "a command is missing; give one of " + commands;
  return "\"" + std::string(argv[1]) + "\" is not a command; give one of " + commands;
}

int run(int argc, char** argv) {
  CLI::App app("Soft shadows on OpenGL ES 2.0: render, trace the truth, measure.", "halfshadow");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer(
      "Exit status: 0 done, 1 the work failed, 2 bad usage. `halfshadow COMMAND --help` lists its options.");
  ExitStatus status = kDone;
  addInfoCommand(app, status);
  addTechniquesCommand(app, status);
  addScenesCommand(app, status);
  addRenderCommand(app, status);
  addReferenceCommand(app, status);
  addMeasureCommand(app, status);
  addReportCommand(app, status);
  addProfileCommand(app, status);
  addCompareCommand(app, status);
  addStressCommand(app, status);
  addValidateCommand(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);  // --help
    say(usageProblem(app, error, argc, argv));
    return kBadUsage;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    say("cannot write standard output; check where it is redirected to");
    return kFailed;
  }
  return status;
}
}  // namespace
}  // namespace halfshadow::cli

int main(int argc, char** argv) {
  using namespace halfshadow;
  setLogSink([](LogLevel level, std::string_view message) {
    if (level == LogLevel::warning) cli::say("warning: " + std::string(message));
  });
  try {
    return cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    cli::say("out of memory; give a smaller --size or fewer --samples");
  } catch (const std::exception& error) {
    cli::say(std::string("internal error: ") + error.what());
  }
  return cli::kFailed;
}
