// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "profile/profile_json.hpp"

#include <algorithm>

namespace halfshadow::profile {
namespace {
template <typename Labelled>
std::size_t indexOf(const std::vector<Labelled>& list, const std::string& label) {
  return static_cast<std::size_t>(std::ranges::find(list, label, &Labelled::label) - list.begin());
}

/// Medians of one configuration, less those of another.
struct Medians {
  double frame = 0.0, receiver = 0.0, unchanged = 0.0, frameCpu = 0.0, unchangedCpu = 0.0;

  static Medians of(const FrameTimes& times) {
    return {times.frame.medianMs, times.receiverPasses.medianMs, times.frameStatic.medianMs,
            times.frameCpu.medianMs, times.frameStaticCpu.medianMs};
  }
  Medians less(const Medians& other) const {
    return {frame - other.frame, receiver - other.receiver, unchanged - other.unchanged,
            frameCpu - other.frameCpu, unchangedCpu - other.unchangedCpu};
  }
};

double quotient(double of, double to) {
  constexpr double kShortestMs = 0.01;
  return to < kShortestMs ? 0.0 : of / to;
}

TimeRatios ratios(const Medians& of, const Medians& to) {
  return {quotient(of.frame, to.frame), quotient(of.receiver, to.receiver),
          quotient(of.unchanged, to.unchanged), quotient(of.frameCpu, to.frameCpu),
          quotient(of.unchangedCpu, to.unchangedCpu)};
}

void add(measure::Json& json, const TimeRatios& times) {
  json["frame"] = times.frame;
  json["receiver_passes"] = times.receiver;
  json["unchanged_frame"] = times.unchanged;
  json["frame_cpu"] = times.frameCpu;
  json["unchanged_frame_cpu"] = times.unchangedCpu;
}

measure::Json timesJson(const measure::TimeStatistics& time) {
  return {{"median", time.medianMs}, {"p95", time.p95Ms}, {"min", time.minMs}, {"frames", time.frames}};
}
}  // namespace

std::vector<RatioResult> ratiosOf(const Suite& suite, const std::vector<FrameTimes>& times) {
  std::vector<RatioResult> results;
  for (const Ratio& ratio : suite.ratios) {
    const FrameTimes& of = times[indexOf(suite.configurations, ratio.of)];
    const FrameTimes& to = times[indexOf(suite.configurations, ratio.to)];
    if (!of.supported || !to.supported) continue;
    results.push_back({ratio.of, ratio.to, ratios(Medians::of(of), Medians::of(to))});
  }
  return results;
}

std::vector<SceneRatioResult> sceneRatiosOf(const Suite& suite, const std::vector<SceneProfile>& scenes) {
  std::vector<SceneRatioResult> results;
  for (const SceneRatio& ratio : suite.sceneRatios) {
    const std::size_t configuration = indexOf(suite.configurations, ratio.configuration);
    const auto mediansIn = [&](const std::string& scene) {
      const std::vector<FrameTimes>& times = scenes[indexOf(suite.scenes, scene)].times;
      const Medians medians = Medians::of(times[configuration]);
      if (ratio.above.empty()) return medians;
      return medians.less(Medians::of(times[indexOf(suite.configurations, ratio.above)]));
    };
    if (!scenes.front().times[configuration].supported) continue;
    results.push_back({ratio, ratios(mediansIn(ratio.of), mediansIn(ratio.to))});
  }
  return results;
}

measure::Json toJson(const Suite& suite, const std::vector<SceneProfile>& scenes) {
  measure::Json json{
      {"suite", suite.name}, {"description", suite.description}, {"scenes", measure::Json::array()}};
  for (const SceneProfile& scene : scenes) {
    measure::Json entry = scene.measurements;
    entry["label"] = scene.label;
    for (std::size_t i = 0; i < scene.times.size(); ++i) {
      measure::Json& technique = entry["techniques"][i];
      technique["label"] = suite.configurations[i].label;
      if (!scene.times[i].supported) continue;
      technique["time_static_ms"] = timesJson(scene.times[i].frameStatic);
      technique["time_cpu_ms"] = timesJson(scene.times[i].frameCpu);
      technique["time_static_cpu_ms"] = timesJson(scene.times[i].frameStaticCpu);
      technique["time_light_passes_ms"] = timesJson(scene.times[i].lightPasses);
      technique["time_receiver_passes_ms"] = timesJson(scene.times[i].receiverPasses);
    }
    entry["ratios"] = measure::Json::array();
    for (const RatioResult& ratio : ratiosOf(suite, scene.times)) {
      measure::Json ofTwo{{"of", ratio.of}, {"to", ratio.to}};
      add(ofTwo, ratio.times);
      entry["ratios"].push_back(std::move(ofTwo));
    }
    json["scenes"].push_back(std::move(entry));
  }
  json["scene_ratios"] = measure::Json::array();
  for (const SceneRatioResult& result : sceneRatiosOf(suite, scenes)) {
    measure::Json entry{{"configuration", result.ratio.configuration},
                        {"above", result.ratio.above},
                        {"of", result.ratio.of},
                        {"to", result.ratio.to}};
    add(entry, result.times);
    json["scene_ratios"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace halfshadow::profile
