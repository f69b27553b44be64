// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "profile/device_profile.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace halfshadow::profile {
namespace {
constexpr std::array<const char*, 3> kSkips = {"branch", "loop", "stencil"};

std::string milliseconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}
}  // namespace

Result<measure::Json> deviceProfile(measure::EngineSession& session, const scene::SceneDescription& scene,
                                    const InterleavedOptions& options) {
  const measure::Json driver = measure::driverJson(session.engine().driver());
  measure::Json choices = measure::Json::array();
  std::array<double, 3> sums{};
  for (const char* kernel : {"4", "7"}) {
    std::vector<measure::Configuration> configurations;
    for (const char* skip : kSkips) {
      configurations.push_back({"pcf-masked", {{"pcf-masked.size", kernel}, {"pcf-masked.skip", skip}}});
    }
    const auto times = interleavedTimes(session, scene, configurations, options);
    if (!times) return times.error();
    if (!times->front().supported) continue;
    const auto fastest =
        std::ranges::min_element(*times, {}, [](const FrameTimes& t) { return t.receiverPasses.medianMs; });
    const char* value = kSkips[static_cast<std::size_t>(fastest - times->begin())];
    measure::Json measured;
    std::string list;
    for (std::size_t i = 0; i < kSkips.size(); ++i) {
      sums[i] += (*times)[i].receiverPasses.medianMs;
      measured[kSkips[i]] = (*times)[i].receiverPasses.medianMs;
      list +=
          (i ? ", " : "") + std::string(kSkips[i]) + " " + milliseconds((*times)[i].receiverPasses.medianMs);
    }
    choices.push_back({{"setting", "pcf-masked.skip"},
                       {"kernel", std::stoi(kernel)},
                       {"value", value},
                       {"ms", measured},
                       {"reason", "receiver passes of pcf-masked, kernel " + std::string(kernel) + ", " +
                                      std::to_string(options.width) + "x" + std::to_string(options.height) +
                                      ", median of " + std::to_string(options.repetitions) +
                                      " frames in turn: " + list + " ms"}});
  }
  measure::Json settings = measure::Json::array();
  if (!choices.empty()) {
    const auto best = std::ranges::min_element(sums);
    settings.push_back({{"key", "filter_skip"},
                        {"value", kSkips[static_cast<std::size_t>(best - sums.begin())]},
                        {"reason", "least time summed over both kernels: " + milliseconds(*best) + " ms"}});
  }
  return measure::Json{{"driver", driver}, {"settings", settings}, {"choices", choices}};
}

}  // namespace halfshadow::profile
