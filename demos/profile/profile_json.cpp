// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "profile/profile_json.hpp"

#include <algorithm>

namespace halfshadow::profile {
namespace {
std::size_t indexOf(const Suite& suite, const std::string& label) {
  const auto found = std::ranges::find(suite.configurations, label, &SuiteConfiguration::label);
  return static_cast<std::size_t>(found - suite.configurations.begin());
}

measure::Json timesJson(const measure::TimeStatistics& time) {
  return {{"median", time.medianMs}, {"p95", time.p95Ms}, {"min", time.minMs}, {"frames", time.frames}};
}
}  // namespace

std::vector<RatioResult> ratiosOf(const Suite& suite, const std::vector<FrameTimes>& times) {
  std::vector<RatioResult> results;
  for (const Ratio& ratio : suite.ratios) {
    const FrameTimes& of = times[indexOf(suite, ratio.of)];
    const FrameTimes& to = times[indexOf(suite, ratio.to)];
    if (!of.supported || !to.supported || to.frame.medianMs <= 0 || to.receiverPasses.medianMs <= 0) continue;
    results.push_back({ratio.of, ratio.to, of.frame.medianMs / to.frame.medianMs,
                       of.receiverPasses.medianMs / to.receiverPasses.medianMs});
  }
  return results;
}

measure::Json toJson(const Suite& suite, const std::vector<SceneProfile>& scenes) {
  measure::Json json{
      {"suite", suite.name}, {"description", suite.description}, {"scenes", measure::Json::array()}};
  for (const SceneProfile& scene : scenes) {
    measure::Json entry = scene.measurements;
    for (std::size_t i = 0; i < scene.times.size(); ++i) {
      measure::Json& technique = entry["techniques"][i];
      technique["label"] = suite.configurations[i].label;
      if (!scene.times[i].supported) continue;
      technique["time_light_passes_ms"] = timesJson(scene.times[i].lightPasses);
      technique["time_receiver_passes_ms"] = timesJson(scene.times[i].receiverPasses);
    }
    entry["ratios"] = measure::Json::array();
    for (const RatioResult& ratio : ratiosOf(suite, scene.times)) {
      entry["ratios"].push_back(
          {{"of", ratio.of}, {"to", ratio.to}, {"frame", ratio.frame}, {"receiver_passes", ratio.receiver}});
    }
    json["scenes"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace halfshadow::profile
