// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "commands.hpp"
#include "json.hpp"
#include "measure/dump.hpp"
#include "options.hpp"
#include "stress/run.hpp"
#include "stress/table.hpp"
#include "text_table.hpp"

namespace halfshadow::cli {
namespace {
struct Arguments {
  std::vector<std::string> cases, techniques{"all"};
  SizeArguments size{.text = "96x72", .width = 96, .height = 72};
  DriverArguments driver;
  SettingArguments settings;
  int samples = 256, variants = 0;
  std::uint64_t seed = 1;
  bool list = false;
  std::string dump, json;
};

ExitStatus listCases(const std::vector<stress::Case>& cases, std::uint64_t seed) {
  TextTable table{.header = {"case", "scenes", "what", "judged"}, .rows = {}, .leftAligned = {0, 2, 3}};
  for (const stress::Case& c : cases)
    table.rows.push_back({c.name, std::to_string(c.make(seed).size()), c.what, stress::ruleText(c.rule)});
  print(table);
  return kDone;
}

Result<std::vector<std::string>> techniquesOf(measure::EngineSession& session,
                                              const std::vector<std::string>& asked) {
  auto chosen = chosenTechniques(session, asked);
  if (!chosen) return chosen;
  const std::vector<std::string> shadowing = stress::shadowTechniques(session);
  std::erase_if(*chosen,
                [&](const std::string& id) { return std::ranges::find(shadowing, id) == shadowing.end(); });
  return chosen;
}

ExitStatus stressTechniques(const Arguments& arguments) {
  const auto cases = stress::chosenCases(arguments.cases);
  if (!cases) return fail(cases.error());
  if (arguments.list) return listCases(*cases, arguments.seed);
  auto session = openSession(arguments.driver);
  if (!session) return fail(session.error());
  if (Status status = checkSize(arguments.size, **session); !status) return fail(status.error());
  const auto ids = techniquesOf(**session, arguments.techniques);
  if (!ids) return fail(ids.error());
  if (Status status = (*session)->set(settingsOf(arguments.settings)); !status)
    return fail(named("--set", status.error()));
  if (Status status = checkJsonPath(arguments.json); !status) return fail(status.error());
  if (!arguments.dump.empty()) {
    if (Status s = measure::prepareDumpFolder(arguments.dump); !s) return fail(named("--dump", s.error()));
  }
  stress::Options options{.width = arguments.size.width,
                          .height = arguments.size.height,
                          .samples = arguments.samples,
                          .seed = arguments.seed,
                          .variantsPerCase = arguments.variants,
                          .settings = settingsOf(arguments.settings),
                          .dumpFolder = arguments.dump};
  const auto start = std::chrono::steady_clock::now();
  const auto table = [&] {
    ProgressLine progress;
    options.progress = [&](const std::string& stage, double share) { progress.update(stage, share); };
    return stress::run(**session, *cases, *ids, options);
  }();
  if (!table) return fail(table.error());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const DriverRecord driver = (*session)->engine().driver();
  Json json = stress::toJson(*table, options, driver);
  json["seconds"] = elapsed.count();
  if (Status status = writeJson(arguments.json, json); !status) return fail(status.error());
  if (printsText(arguments.json)) {
    std::printf("%s, %s, %d light points per pixel, seed %llu\n", driver.renderer,
                arguments.size.text.c_str(), reference::tracedSamples(options.samples),
                static_cast<unsigned long long>(options.seed));
    print({.header = {}, .rows = stress::summaryRows(*table)});
    std::printf("\n");
    for (const std::string& line : stress::remarks(*table)) std::printf("%s\n", line.c_str());
    std::printf("%s, in %.0f s\n", stress::countsText(*table).c_str(), elapsed.count());
  }
  if (const std::size_t wrong = table->count(stress::Verdict::wrong); wrong > 0) {
    say(std::to_string(wrong) + " cells are wrong" +
        (arguments.dump.empty() ? "; --dump FOLDER writes their pictures" : "; see " + arguments.dump));
    return kFailed;
  }
  return kDone;
}
}  // namespace

void addStressCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("stress", "every technique in every scene that can break one: a table of verdicts");
  command->add_option("CASES", arguments->cases,
                      "names of cases, or their beginnings (see --list; default: all)");
  command->add_flag("--list", arguments->list, "list the cases and how they are judged, and do nothing");
  command
      ->add_option("-t,--technique", arguments->techniques,
                   "techniques, separated by commas, or all (default: all that draw shadows)")
      ->delimiter(',')
      ->allow_extra_args(false);
  addSettingArguments(*command, arguments->settings);
  addSizeArgument(*command, arguments->size);
  command->add_option("--samples", arguments->samples, "light points per pixel of the truth")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "of the cases' random numbers")->capture_default_str();
  command
      ->add_option("--variants", arguments->variants,
                   "at most so many scenes of each case, chosen by the seed; 0 = all")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option(
      "--dump", arguments->dump,
      "folder for pictures of cells that are worse or wrong: expected, actual, error (red: too "
      "bright, blue: too dark; times 4)");
  addDriverArguments(*command, arguments->driver);
  addJsonArgument(*command, arguments->json);
  command->callback([arguments, &status] { status = stressTechniques(*arguments); });
}

}  // namespace halfshadow::cli
