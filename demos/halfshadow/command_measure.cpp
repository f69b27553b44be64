// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cstdio>

#include "commands.hpp"
#include "json.hpp"
#include "measure/dump.hpp"
#include "options.hpp"
#include "text_table.hpp"

namespace halfshadow::cli {
namespace {
struct Arguments {
  SceneArguments scene;
  SizeArguments size;
  DriverArguments driver;
  SettingArguments settings;
  std::vector<std::string> techniques{"all"};
  TruthArguments truth;
  int frames = 5;
  std::string dump, json;
};

void printHeading(const scene::SceneDescription& scene, const DriverRecord& driver,
                  const measure::Truth& truth) {
  std::printf("%s, %dx%d, %s\n", scene.name.c_str(), truth.width, truth.height, driver.renderer);
  std::printf(
      "truth: %d light points per pixel, noise RMSE %.5f; %zu receiver pixels, %zu of them in penumbra\n",
      truth.samples, truth.noiseRmse, truth.receiverPixels, truth.penumbraPixels);
}

void printTable(const std::vector<measure::TechniqueMeasurement>& techniques) {
  TextTable table{.header = {"technique", "penumbra rmse", "p99", "max", "receiver mae", "taps/px", "ms",
                             "ms static", "passes", "FBO switches", "MiB"}};
  for (const measure::TechniqueMeasurement& t : techniques) {
    if (!t.measured()) continue;
    const bool timed = t.time.frames > 0;
    table.rows.push_back({t.id, fixedText(t.error.penumbra.rmse, 4), fixedText(t.error.penumbra.p99, 3),
                          fixedText(t.error.penumbra.max, 3), fixedText(t.error.receiver.mae, 5),
                          fixedText(t.counters.tapsPerPixel, 1), timed ? fixedText(t.time.medianMs, 2) : "-",
                          timed ? fixedText(t.timeStatic.medianMs, 2) : "-",
                          std::to_string(t.counters.passes), std::to_string(t.counters.framebufferSwitches),
                          fixedText(static_cast<double>(t.memoryBytes) / (1 << 20), 1)});
  }
  print(table);
  for (const measure::TechniqueMeasurement& t : techniques) {
    if (!t.measured()) std::printf("%s: %s\n", t.id.c_str(), t.absence().c_str());
  }
}

Status checkOutputs(const Arguments& arguments) {
  if (Status status = checkJsonPath(arguments.json); !status) return status;
  if (arguments.dump.empty()) return {};
  const Status status = measure::prepareDumpFolder(arguments.dump);
  return status ? Status{} : Status(named("--dump", status.error()));
}

Result<std::vector<measure::TechniqueMeasurement>> measureAll(measure::EngineSession& session,
                                                              const scene::SceneDescription& scene,
                                                              const measure::Truth& truth,
                                                              const std::vector<std::string>& ids,
                                                              const Arguments& arguments) {
  std::vector<measure::TechniqueMeasurement> techniques;
  ProgressLine progress;
  for (const std::string& id : ids) {
    progress.update("measuring " + id,
                    static_cast<double>(techniques.size()) / static_cast<double>(ids.size()));
    auto measured = measure::measureTechnique(session, scene, truth, {id, settingsOf(arguments.settings)},
                                              {.timingFrames = arguments.frames});
    if (!measured) return measured.error();
    techniques.push_back(std::move(measured).value());
  }
  return techniques;
}

ExitStatus measureScene(const Arguments& arguments) {
  auto session = openSession(arguments.driver);
  if (!session) return fail(session.error());
  if (Status status = checkSize(arguments.size, **session); !status) return fail(status.error());
  const auto ids = chosenTechniques(**session, arguments.techniques);
  if (!ids) return fail(ids.error());
  if (Status status = (*session)->set(settingsOf(arguments.settings)); !status) {
    return fail(named("--set", status.error()));
  }
  const auto scene = openScene(arguments.scene);
  if (!scene) return fail(scene.error());
  if (Status status = checkOutputs(arguments); !status) return fail(status.error());
  if (scene->lights.size() > 1) say("note: only the first of the scene's lights is measured");

  auto truth = [&] {
    ProgressLine progress;
    return measure::traceTruth(
        *scene, arguments.size.width, arguments.size.height, arguments.truth.samples,
        [&progress](const std::string& stage, double share) { progress.update(stage, share); },
        arguments.truth.originLiftWorld);
  }();
  if (!truth) return fail(truth.error());
  if (truth->receiverPixels == 0) {
    return fail({ErrorCode::emptyScene, scene->name +
                                            ": no pixel shows a receiver that faces the light, so there is "
                                            "nothing to measure; point --camera at the scene"});
  }
  const auto techniques = measureAll(**session, *scene, *truth, *ids, arguments);
  if (!techniques) return fail(techniques.error());
  const DriverRecord driver = (*session)->engine().driver();
  if (!arguments.dump.empty()) {
    const Status dumped = measure::dumpMeasurement(arguments.dump, *scene, *truth, *techniques);
    if (!dumped) return fail(dumped.error());
  }
  const Status written = writeJson(arguments.json, measure::toJson(*scene, driver, *truth, *techniques));
  if (!written) return fail(written.error());
  if (printsText(arguments.json)) {
    printHeading(*scene, driver, *truth);
    printTable(*techniques);
  }
  if (!printsText(arguments.json)) {
    for (const measure::TechniqueMeasurement& t : *techniques) {
      if (!t.failure.empty()) say(t.id + ": " + t.absence());
    }
  }
  // One that fails leaves the others' figures; where none is measured, nothing was done.
  ExitStatus status = kDone;
  if (std::ranges::none_of(*techniques, &measure::TechniqueMeasurement::measured)) {
    say("no technique could draw the scene");
    status = kFailed;
  }
  for (const measure::TechniqueMeasurement& technique : *techniques) {
    if (technique.supported ||
        std::ranges::find(arguments.techniques, technique.id) == arguments.techniques.end()) {
      continue;
    }
    say("-t " + technique.id + ": not supported here: " + technique.unsupportedReason +
        "; choose another technique or --driver");
    status = kFailed;
  }
  return status;
}
}  // namespace

void addMeasureCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("measure", "techniques against ray-traced truth: errors, counters, times");
  addSceneArguments(*command, arguments->scene);
  command
      ->add_option("-t,--technique", arguments->techniques,
                   "techniques, separated by commas, or all (default: all)")
      ->delimiter(',')
      ->allow_extra_args(false);
  addSettingArguments(*command, arguments->settings);
  addSizeArgument(*command, arguments->size);
  addTruthArguments(*command, arguments->truth);
  command
      ->add_option("--frames", arguments->frames,
                   "frames timed per technique, moving light and standing still each; 0 times nothing")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option(
      "--dump", arguments->dump,
      "folder for geometry, light, positions, normals, truth and each technique's visibility");
  addDriverArguments(*command, arguments->driver);
  addJsonArgument(*command, arguments->json);
  command->callback([arguments, &status] { status = measureScene(*arguments); });
}

}  // namespace halfshadow::cli
