// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "images/images.hpp"
#include "measure/measurement.hpp"
#include "measure/text_file.hpp"
#include "options.hpp"
#include "papers/papers.hpp"
#include "report/report.hpp"
#include "report/scene_pictures.hpp"
#include "stress/section.hpp"
#include "stress/table.hpp"

namespace halfshadow::cli {
namespace {
struct Arguments {
  std::vector<std::string> scenes;
  std::vector<std::string> techniques{"all"};
  SizeArguments size{.text = "480x300", .width = 480, .height = 300};
  DriverArguments driver;
  SettingArguments settings;
  std::string folder;
  bool papers = false, stress = false;
  int samples = 1024, frames = 5;
};

/// "builtin:figure@light=1" → "figure_light_1", a path → its stem.
std::string fileStem(const std::string& source) {
  std::string stem = source.starts_with("builtin:") ? source.substr(std::string("builtin:").size())
                                                    : std::filesystem::path(source).stem().string();
  std::ranges::replace_if(
      stem, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '-'; }, '_');
  return stem;
}

/// What names this run's driver on another command line.
scenes::ViewCommand deviceWords(const DriverArguments& driver) {
  scenes::ViewCommand words;
  for (const std::string& text : driver.force) words.forcedOff.push_back(text.substr(0, text.find('=')));
  words.driver = driver.driver, words.eglLibrary = driver.eglLibrary;
  words.deviceProfile = driver.deviceProfile;
  return words;
}

/// Errors: fileNotWritable (--output), those of reading scenes and rendering.
Result<report::SceneReport> reportScene(measure::EngineSession& session, const std::string& source,
                                        const std::vector<std::string>& ids, const Arguments& arguments) {
  const auto scene = openScene({.source = source});
  if (!scene) return scene.error();
  ProgressLine progress;
  auto truth = measure::traceTruth(
      *scene, arguments.size.width, arguments.size.height, arguments.samples,
      [&](const std::string& stage, double share) { progress.update(source + ": " + stage, share); });
  if (!truth) return truth.error();
  report::SceneReport result{
      .title = source.starts_with("builtin:") ? source : std::filesystem::path(source).filename().string(),
      .description = report::describeScene(*scene),
      .view = deviceWords(arguments.driver),
      .truth = std::move(*truth)};
  const std::vector<measure::Setting> settings = settingsOf(arguments.settings);
  result.view.source = source;
  // One light is measured, also of a scene with more.
  if (scene->lights.size() > 1) result.view.lights = {scene->lights.front()};
  for (const measure::Setting& setting : settings)
    result.view.settings.emplace_back(setting.key, setting.value);
  result.view.width = arguments.size.width, result.view.height = arguments.size.height;
  for (const std::string& id : ids) {
    progress.update(source + ": " + id,
                    static_cast<double>(result.techniques.size()) / static_cast<double>(ids.size()));
    auto measured = measure::measureTechnique(session, *scene, result.truth, {id, settings},
                                              {.timingFrames = arguments.frames});
    if (!measured) return measured.error();
    const bool drawn = measured->measured();
    result.techniques.push_back(std::move(*measured));
    if (!drawn) continue;
    auto shaded =
        report::renderShaded(session, *scene, {id, settings}, arguments.size.width, arguments.size.height);
    if (!shaded) return shaded.error();
    const auto path = std::filesystem::path(arguments.folder) / (fileStem(source) + "-" + id + ".png");
    if (Status status = images::writePng(path, shaded->width, shaded->height, 4, shaded->pixels); !status) {
      return status.error();
    }
    // The page shows the scene once, under its best shadows.
    const auto better = [](const measure::TechniqueMeasurement& a, const measure::TechniqueMeasurement& b) {
      return a.measured() && (!b.measured() || a.error.penumbra.rmse < b.error.penumbra.rmse);
    };
    if (std::ranges::min_element(result.techniques, better)->id == id) {
      result.shaded = std::move(*shaded);
      result.shadedWith = id;
    }
  }
  return result;
}

void printScene(const report::SceneReport& scene) {
  std::printf("%s\n", scene.title.c_str());
  for (const measure::TechniqueMeasurement& t : scene.techniques) {
    if (t.measured()) {
      std::printf("  %-14s penumbra RMSE %.4f  receiver MAE %.4f  %8.2f ms\n", t.id.c_str(),
                  t.error.penumbra.rmse, t.error.receiver.mae, t.time.medianMs);
    } else {
      std::printf("  %-14s %s\n", t.id.c_str(), t.absence().c_str());
    }
  }
  std::fflush(stdout);
}

/// Every paper's comparison; papers.json beside the page has the numbers. Errors: fileNotWritable (--output),
/// those of rendering.
Status addPapers(measure::EngineSession& session, const Arguments& arguments, report::Report& document) {
  using Paper = Result<papers::PaperResult> (*)(measure::EngineSession&, const papers::PaperOptions&);
  papers::PaperOptions options{.samples = arguments.samples, .device = deviceWords(arguments.driver)};
  options.repetitions = std::min(arguments.frames, options.repetitions);
  const auto model = std::ranges::find_if(
      arguments.scenes, [](const std::string& source) { return !source.starts_with("builtin:"); });
  if (model != arguments.scenes.end()) options.model = *model;
  measure::Json json = measure::Json::array();
  for (const Paper paper :
       {papers::occlusionTextures2006, papers::shadowWidth2003, papers::penumbraWedges2006}) {
    ProgressLine progress;
    options.progress = [&](const std::string& stage, double share) { progress.update(stage, share); };
    auto result = paper(session, options);
    if (!result) return result.error();
    document.sections.push_back(std::move(result->section));
    json.push_back(std::move(result->json));
  }
  document.sections.push_back(
      {"Evans, Agenjo, Blat 2014: filters of variable penumbra",
       {report::paragraphHtml(
           "Its comparison of masks against full kernels (hard, 4x4, 7x7, variable penumbra; a person of "
           "50,000 vertices at 1280x720) is a benchmark of its own: halfshadow profile evans -o FOLDER "
           "writes "
           "times, ratios, errors and pictures.")}});
  const auto path = std::filesystem::path(arguments.folder) / "papers.json";
  return measure::writeTextFile(path, json.dump(2) + "\n");
}

/// Small pictures of few scenes a case: half a minute where the whole table takes minutes.
Status addStress(measure::EngineSession& session, const std::vector<std::string>& ids,
                 const Arguments& arguments, report::Report& document) {
  ProgressLine progress;
  const stress::Options options{.width = 96,
                                .height = 72,
                                .samples = 144,
                                .variantsPerCase = 1,
                                .settings = settingsOf(arguments.settings),
                                .progress = [&](const std::string& stage, double share) {
                                  progress.update("stress: " + stage, share);
                                }};
  std::vector<std::string> shadowing = stress::shadowTechniques(session);
  std::erase_if(shadowing, [&](const std::string& id) { return std::ranges::find(ids, id) == ids.end(); });
  auto table = stress::run(session, stress::cases(), shadowing, options);
  if (!table) return table.error();
  document.sections.push_back(stress::section(*table, options));
  std::printf("stress: %s\n", stress::countsText(*table).c_str());
  return {};
}

ExitStatus makeReport(const Arguments& arguments) {
  if (arguments.scenes.empty() && !arguments.papers && !arguments.stress) {
    say("report: there is nothing to show; give scenes, --papers, --stress or several of them");
    return kBadUsage;
  }
  auto session = openSession(arguments.driver);
  if (!session) return fail(session.error());
  if (Status status = checkSize(arguments.size, **session); !status) return fail(status.error());
  const auto ids = chosenTechniques(**session, arguments.techniques);
  if (!ids) return fail(ids.error());
  if (Status status = (*session)->set(settingsOf(arguments.settings)); !status) {
    return fail(named("--set", status.error()));
  }
  std::error_code failure;
  std::filesystem::create_directories(arguments.folder, failure);
  const std::filesystem::path page = std::filesystem::path(arguments.folder) / "report.html";
  if (Status status = measure::checkWritable(page); !status) return fail(named("--output", status.error()));

  report::Report document{
      .title = "Halfshadow: soft shadows against ray-traced truth",
      .introduction =
          "Each technique's visibility (1 lit, 0 umbra) is compared with ray-traced visibility of the "
          "same rectangular light, pixel by pixel. Times are medians of " +
          std::to_string(arguments.frames) + " frames of " + arguments.size.text +
          " pixels on this device; on a software driver they rank the work, not a phone's GPU.",
      .device = report::deviceOf((*session)->engine().driver())};
  for (const std::string& source : arguments.scenes) {
    auto scene = reportScene(**session, source, *ids, arguments);
    if (!scene) return fail(scene.error());
    printScene(*scene);
    document.scenes.push_back(std::move(*scene));
  }
  if (arguments.papers) {
    if (Status status = addPapers(**session, arguments, document); !status) return fail(status.error());
  }
  if (arguments.stress) {
    if (Status status = addStress(**session, *ids, arguments, document); !status) return fail(status.error());
  }
  if (Status status = report::writeReport(page, document); !status) return fail(status.error());
  std::printf("wrote %s\n", page.c_str());
  return kDone;
}
}  // namespace

void addReportCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("report", "measures several scenes into one HTML page with pictures");
  command->add_option("SCENE", arguments->scenes, ".gltf or .glb files, or builtin:NAME");
  command->add_flag("--papers", arguments->papers,
                    "also repeat the comparisons of the papers that the techniques come from, over built-in "
                    "scenes and the first file given; numbers go to papers.json");
  command->add_flag(
      "--stress", arguments->stress,
      "also show verdicts on scenes that break soft shadows, one scene a case (all: `halfshadow "
      "stress`)");
  command->add_option("-o,--output", arguments->folder, "folder for report.html and the shaded images")
      ->required();
  command
      ->add_option("-t,--technique", arguments->techniques,
                   "techniques, separated by commas, or all (default: all)")
      ->delimiter(',')
      ->allow_extra_args(false);
  addSettingArguments(*command, arguments->settings);
  addSizeArgument(*command, arguments->size);
  command->add_option("--samples", arguments->samples, "light points per pixel of the truth")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  command->add_option("--frames", arguments->frames, "frames timed per technique; 0 times nothing")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  addDriverArguments(*command, arguments->driver);
  command->callback([arguments, &status] { status = makeReport(*arguments); });
}

}  // namespace halfshadow::cli
