// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "measure/text_file.hpp"
#include "options.hpp"
#include "profile/compiled_counts.hpp"
#include "profile/device_profile.hpp"
#include "profile/profile_json.hpp"
#include "report/report.hpp"
#include "report/scene_pictures.hpp"
#include "text_table.hpp"

namespace halfshadow::cli {
namespace {
struct Arguments {
  std::string suite = "quick", folder;
  DriverArguments driver;
};

/// A scene's measurements for the JSON file and for the page.
struct ProfiledScene {
  profile::SceneProfile profile;
  report::SceneReport page;
};

/// The timed picture must be the measured one: same engine code, but another engine with another history.
Status checkPicture(const profile::SuiteConfiguration& configuration, const std::vector<float>& measured,
                    const std::vector<float>& timed) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) different += measured[i] != timed[i] ? 1 : 0;
  if (different == 0) return {};
  return Error{ErrorCode::internal,
               configuration.label + ": " + std::to_string(different) +
                   " pixels of the timed picture differ from the measured one; its time would "
                   "belong to another image"};
}

Result<ProfiledScene> profileScene(measure::EngineSession& session, const profile::Suite& suite,
                                   const profile::SuiteScene& profiled) {
  const auto scene = openScene({.source = profiled.source, .camera = profiled.camera});
  if (!scene) return scene.error();
  ProgressLine line;
  const measure::Progress progress = [&](const std::string& stage, double share) {
    line.update(profiled.label + ": " + stage, share);
  };
  auto truth = measure::traceTruth(*scene, suite.width, suite.height, suite.samples, progress);
  if (!truth) return truth.error();
  std::vector<measure::Configuration> configurations;
  std::vector<measure::TechniqueMeasurement> measured;
  for (const profile::SuiteConfiguration& entry : suite.configurations) {
    progress("errors of " + entry.label,
             static_cast<double>(measured.size()) / static_cast<double>(suite.configurations.size()));
    configurations.push_back(entry.configuration);
    auto technique =
        measure::measureTechnique(session, *scene, *truth, entry.configuration, {.timingFrames = 0});
    if (!technique) return technique.error();
    measured.push_back(std::move(*technique));
  }
  auto times = profile::interleavedTimes(
      session, *scene, configurations,
      {.width = suite.width, .height = suite.height, .repetitions = suite.repetitions, .progress = progress});
  if (!times) return times.error();
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!measured[i].supported) continue;
    if (Status s = checkPicture(suite.configurations[i], measured[i].visibility, (*times)[i].visibility);
        !s) {
      return s.error();
    }
    measured[i].time = (*times)[i].frame;
  }
  ProfiledScene result{
      .profile = {profiled.label, measure::toJson(*scene, session.engine().driver(), *truth, measured),
                  std::move(*times)},
      .page = {
          .title = profiled.label, .description = report::describeScene(*scene), .truth = std::move(*truth)}};
  result.page.techniques = std::move(measured);
  return result;
}

const std::vector<std::string> kRatioColumns = {"frame", "receiver passes", "unchanged frame", "CPU, frame",
                                                "CPU, unchanged"};

std::vector<std::string> ratioRow(const std::string& name, const profile::TimeRatios& times) {
  const auto text = [](double ratio) { return ratio > 0 ? fixedText(ratio, 2) : std::string("–"); };
  return {name,
          text(times.frame),
          text(times.receiver),
          text(times.unchanged),
          text(times.frameCpu),
          text(times.unchangedCpu)};
}

report::Table ratioTable(const profile::Suite& suite, const profile::SceneProfile& scene) {
  report::Table table{
      .title = "Ratios, " + scene.label,
      .note =
          "Time of the first divided by time of the second: whole frames with a moving light; only their "
          "passes over receivers, without shadow maps and masks; frames in which nothing changed; and the "
          "process's CPU time of both kinds of frame.",
      .header = {"times"}};
  table.header.insert(table.header.end(), kRatioColumns.begin(), kRatioColumns.end());
  for (const profile::RatioResult& ratio : profile::ratiosOf(suite, scene.times)) {
    table.rows.push_back(ratioRow(ratio.of + " / " + ratio.to, ratio.times));
  }
  return table;
}

report::Table sceneRatioTable(const profile::Suite& suite, const std::vector<profile::SceneProfile>& scenes) {
  report::Table table{.title = "Ratios between scenes",
                      .note =
                          "Time in the first scene divided by time in the second, of what a configuration "
                          "takes above another.",
                      .header = {"times"}};
  table.header.insert(table.header.end(), kRatioColumns.begin(), kRatioColumns.end());
  for (const profile::SceneRatioResult& result : profile::sceneRatiosOf(suite, scenes)) {
    const profile::SceneRatio& ratio = result.ratio;
    table.rows.push_back(ratioRow(ratio.configuration + (ratio.above.empty() ? "" : " above " + ratio.above) +
                                      ": " + ratio.of + " / " + ratio.to,
                                  result.times));
  }
  return table;
}

report::Table compiledTable(const profile::CompiledCounts& compiled) {
  return {.title = "Compiled for mobile GPUs",
          .note = compiled.note,
          .header = compiled.header,
          .rows = compiled.rows};
}

void printTable(const report::Table& table) {
  if (!table.rows.empty()) print(TextTable{.header = table.header, .rows = table.rows});
  std::fflush(stdout);
}

void printScene(const profile::Suite& suite, const ProfiledScene& scene) {
  std::printf("%s, %dx%d\n", scene.profile.label.c_str(), suite.width, suite.height);
  TextTable table{.header = {"configuration", "penumbra rmse", "taps/px", "ms frame", "light passes",
                             "receiver passes", "unchanged", "CPU frame", "CPU unchanged"}};
  for (std::size_t i = 0; i < suite.configurations.size(); ++i) {
    const profile::FrameTimes& times = scene.profile.times[i];
    if (!times.supported) continue;
    const measure::TechniqueMeasurement& t = scene.page.techniques[i];
    table.rows.push_back({suite.configurations[i].label, fixedText(t.error.penumbra.rmse, 4),
                          fixedText(t.counters.tapsPerPixel, 2), fixedText(times.frame.medianMs, 2),
                          fixedText(times.lightPasses.medianMs, 2),
                          fixedText(times.receiverPasses.medianMs, 2),
                          fixedText(times.frameStatic.medianMs, 2), fixedText(times.frameCpu.medianMs, 2),
                          fixedText(times.frameStaticCpu.medianMs, 2)});
  }
  print(table);
  printTable(ratioTable(suite, scene.profile));
}

Status writeJsonFile(const std::filesystem::path& path, const measure::Json& json) {
  return measure::writeTextFile(path, json.dump(2) + "\n");
}

ExitStatus makeProfile(const Arguments& arguments) {
  const auto suite = profile::readSuite(arguments.suite);
  if (!suite) return fail(suite.error());
  auto session = openSession(arguments.driver);
  if (!session) return fail(session.error());
  const std::filesystem::path folder(arguments.folder);
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  for (const char* file : {"profile.json", "device.json", "report.html"}) {
    if (Status s = measure::checkWritable(folder / file); !s) return fail(named("--output", s.error()));
  }

  report::Report document{
      .title = "Halfshadow profile: " + suite->name,
      .introduction = suite->description + " Times are medians of " + std::to_string(suite->repetitions) +
                      " dynamic frames, all configurations in turn; each timed picture was "
                      "checked to be the measured one.",
      .device = report::deviceOf((*session)->engine().driver())};
  std::vector<profile::SceneProfile> profiles;
  for (const profile::SuiteScene& profiled : suite->scenes) {
    auto scene = profileScene(**session, *suite, profiled);
    if (!scene) return fail(scene.error());
    printScene(*suite, *scene);
    if (!suite->ratios.empty()) document.tables.push_back(ratioTable(*suite, scene->profile));
    document.scenes.push_back(std::move(scene->page));
    profiles.push_back(std::move(scene->profile));
  }
  if (!suite->sceneRatios.empty()) {
    document.tables.push_back(sceneRatioTable(*suite, profiles));
    printTable(document.tables.back());
  }
  const auto compiled = profile::compiledCounts(*suite);
  if (!compiled) return fail(compiled.error());
  if (!compiled->rows.empty()) {
    document.tables.push_back(compiledTable(*compiled));
    std::printf("%s\n", compiled->note.c_str());
    printTable(document.tables.back());
  }
  const auto scene = openScene({.source = suite->scenes.front().source});
  if (!scene) return fail(scene.error());
  const auto device = profile::deviceProfile(
      **session, *scene, {.width = suite->width, .height = suite->height, .repetitions = suite->repetitions});
  if (!device) return fail(device.error());
  for (const measure::Json& choice : (*device)["choices"]) {
    std::printf("%s = %s: %s\n", choice["setting"].get<std::string>().c_str(),
                choice["value"].get<std::string>().c_str(), choice["reason"].get<std::string>().c_str());
  }
  measure::Json results = profile::toJson(*suite, profiles);
  results["compiled"] = {{"note", compiled->note}, {"header", compiled->header}, {"rows", compiled->rows}};
  if (Status s = writeJsonFile(folder / "profile.json", results); !s) return fail(s.error());
  if (Status s = writeJsonFile(folder / "device.json", *device); !s) return fail(s.error());
  if (Status s = report::writeReport(folder / "report.html", document); !s) return fail(s.error());
  std::printf("wrote profile.json, device.json and report.html to %s\n", folder.c_str());
  return kDone;
}
}  // namespace

void addProfileCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("profile", "run time against error on this device; writes a device profile");
  command
      ->add_option("SUITE", arguments->suite,
                   "quick, evans, forest or occlusion, or the .json file of a suite of your own")
      ->capture_default_str();
  command
      ->add_option("-o,--output", arguments->folder, "folder for profile.json, device.json and report.html")
      ->required();
  addDriverArguments(*command, arguments->driver);
  command->callback([arguments, &status] { status = makeProfile(*arguments); });
}

}  // namespace halfshadow::cli
