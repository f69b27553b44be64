// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "papers/comparison.hpp"

#include <algorithm>

#include "report/html.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::papers {
namespace {

/// Why a variant cannot run here; empty when it can.
std::string problemOf(Engine& engine, const Variant& variant) {
  const std::string& id = variant.configuration.technique;
  const TechniqueRecord* found = nullptr;
  TechniqueRecord record;
  for (std::size_t i = 0; i < engine.techniqueCount() && found == nullptr; ++i) {
    record = engine.technique(i);
    if (id == record.id) found = &record;
  }
  if (found == nullptr) return "this version has no technique " + id;
  if (!found->supported) return "not supported here: " + std::string(found->unsupportedReason);
  for (const measure::Setting& setting : variant.configuration.settings) {
    bool known = false;
    for (std::size_t i = 0; i < engine.settingCount() && !known; ++i)
      known = setting.key == engine.setting(i).key;
    if (!known) return "this version has no setting " + setting.key;
  }
  return {};
}

measure::Json timeJson(const measure::TimeStatistics& time) {
  return {{"median", time.medianMs}, {"p95", time.p95Ms}, {"min", time.minMs}, {"frames", time.frames}};
}

}  // namespace

Available availableOf(measure::EngineSession& session, const std::vector<Variant>& variants) {
  Available result;
  for (const Variant& variant : variants) {
    const std::string problem = problemOf(session.engine(), variant);
    if (problem.empty()) {
      result.variants.push_back(variant);
    } else {
      result.leftOut.push_back(variant.label + ": " + problem);
    }
  }
  return result;
}

Result<Comparison> compare(measure::EngineSession& session, const std::string& source,
                           const std::vector<Variant>& variants, const PaperOptions& options) {
  const auto scene = scenes::openScene(source, {});
  if (!scene) return scene.error();
  const measure::Progress progress = [&](const std::string& stage, double share) {
    if (options.progress) options.progress(source + ": " + stage, share);
  };
  auto truth = measure::traceTruth(*scene, options.width, options.height, options.samples, progress);
  if (!truth) return truth.error();
  Comparison result{.source = source, .view = options.device, .truth = std::move(*truth)};
  result.view.source = source;
  result.view.width = options.width, result.view.height = options.height;
  std::vector<measure::Configuration> configurations;
  for (const Variant& variant : variants) {
    progress("errors of " + variant.label,
             static_cast<double>(result.variants.size()) / static_cast<double>(variants.size()));
    auto measured =
        measure::measureTechnique(session, *scene, result.truth, variant.configuration, {.timingFrames = 0});
    if (!measured) return measured.error();
    if (!measured->measured())
      return Error{ErrorCode::driverFault, source + ": " + variant.label + ": " + measured->absence()};
    configurations.push_back(variant.configuration);
    result.variants.push_back({variant, std::move(*measured), {}});
  }
  if (options.repetitions < 1 || variants.empty()) return result;
  auto times = profile::interleavedTimes(session, *scene, configurations,
                                         {.width = options.width,
                                          .height = options.height,
                                          .repetitions = options.repetitions,
                                          .progress = progress});
  if (!times) return times.error();
  for (std::size_t i = 0; i < result.variants.size(); ++i) result.variants[i].times = std::move((*times)[i]);
  return result;
}

std::string errorText(const measure::TechniqueMeasurement& measurement) {
  const auto& error = measurement.error.penumbra;
  return "penumbra RMSE " + report::fixed(error.rmse, 4) + " (ground " +
         report::fixed(measurement.errorOnGround.penumbra.rmse, 4) + "), p99 " + report::fixed(error.p99, 3) +
         ", largest " + report::fixed(error.max, 2);
}

Result<std::string> picturesOf(const Comparison& comparison, std::size_t first, std::size_t count) {
  std::vector<report::ComparedPicture> pictures;
  const std::size_t end = first + std::min(count, comparison.variants.size() - first);
  for (std::size_t i = first; i < end; ++i) {
    const ComparedVariant& variant = comparison.variants[i];
    std::string numbers = errorText(variant.measurement);
    if (variant.times.frame.frames > 0) numbers += " · " + report::timeText(variant.times.frame) + " ms";
    scenes::ViewCommand view = comparison.view;
    view.technique = variant.variant.configuration.technique;
    for (const measure::Setting& setting : variant.variant.configuration.settings)
      view.settings.emplace_back(setting.key, setting.value);
    pictures.push_back({.title = variant.variant.label,
                        .view = std::move(view),
                        .measurement = &variant.measurement,
                        .numbers = std::move(numbers)});
  }
  return report::comparisonHtml(comparison.truth, pictures);
}

std::string conditionsText(const PaperOptions& options) {
  return std::to_string(options.width) + "x" + std::to_string(options.height) + " pixels" +
         (options.repetitions > 0 ? "; times are medians of " + std::to_string(options.repetitions) +
                                        " frames, configurations in turn."
                                  : ".");
}

measure::Json toJson(const Comparison& comparison) {
  measure::Json json{
      {"scene", comparison.source},
      {"size", {comparison.truth.width, comparison.truth.height}},
      {"truth", {{"samples", comparison.truth.samples}, {"noise_rmse", comparison.truth.noiseRmse}}},
      {"variants", measure::Json::array()}};
  for (const ComparedVariant& variant : comparison.variants) {
    measure::Json entry{{"label", variant.variant.label},
                        {"technique", variant.measurement.id},
                        {"settings", measure::toJson(variant.measurement.settings)},
                        {"error",
                         {{"receiver", measure::toJson(variant.measurement.error.receiver)},
                          {"penumbra", measure::toJson(variant.measurement.error.penumbra)},
                          {"penumbra_ground", measure::toJson(variant.measurement.errorOnGround.penumbra)}}},
                        {"counters", measure::toJson(variant.measurement.counters)},
                        {"memory_bytes", variant.measurement.memoryBytes}};
    if (const profile::FrameTimes& times = variant.times; times.frame.frames > 0) {
      entry["time_ms"] = timeJson(times.frame);
      entry["time_static_ms"] = timeJson(times.frameStatic);
      entry["time_light_passes_ms"] = timeJson(times.lightPasses);
      entry["time_receiver_passes_ms"] = timeJson(times.receiverPasses);
      entry["passes"] = measure::Json::array();
      for (const profile::PassTime& pass : times.passes) {
        entry["passes"].push_back(
            {{"name", pass.name}, {"light_space", pass.lightSpace}, {"median_ms", pass.medianMs}});
      }
    }
    json["variants"].push_back(std::move(entry));
  }
  return json;
}

void noteLeftOut(report::Section& section, const std::vector<std::string>& leftOut) {
  std::string text;
  for (const std::string& entry : leftOut) text += (text.empty() ? "Left out: " : "; ") + entry;
  if (!text.empty()) section.blocks.push_back(report::paragraphHtml(text + "."));
}

}  // namespace halfshadow::papers
