// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "profile/device_profile.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace halfshadow::profile {
namespace {
constexpr std::array<const char*, 3> kSkips = {"branch", "loop", "stencil"};
/// The setting's two values first.
constexpr std::array<const char*, 3> kPrefilters = {"nbuffer", "sat", "mipmap"};

std::string milliseconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::string conditions(const InterleavedOptions& options) {
  return std::to_string(options.width) + "x" + std::to_string(options.height) + ", median of " +
         std::to_string(options.repetitions) + " frames in turn: ";
}

/// Adds to "settings" and "choices" which way of skipping the filter is fastest.
Status addFilterSkip(measure::EngineSession& session, const scene::SceneDescription& scene,
                     const InterleavedOptions& options, measure::Json& profile) {
  std::array<double, 3> sums{};
  for (const char* kernel : {"4", "7"}) {
    std::vector<measure::Configuration> configurations;
    for (const char* skip : kSkips) {
      configurations.push_back({"pcf-masked", {{"pcf-masked.size", kernel}, {"pcf-masked.skip", skip}}});
    }
    const auto times = interleavedTimes(session, scene, configurations, options);
    if (!times) return times.error();
    if (!times->front().supported) return {};
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
    profile["choices"].push_back({{"setting", "pcf-masked.skip"},
                                  {"kernel", std::stoi(kernel)},
                                  {"value", value},
                                  {"ms", measured},
                                  {"reason", "receiver passes of pcf-masked, kernel " + std::string(kernel) +
                                                 ", " + conditions(options) + list + " ms"}});
  }
  const auto best = std::ranges::min_element(sums);
  profile["settings"].push_back(
      {{"key", "filter_skip"},
       {"value", kSkips[static_cast<std::size_t>(best - sums.begin())]},
       {"reason", "least time summed over both kernels: " + milliseconds(*best) + " ms"}});
  return {};
}

/// The same for the prefilter of occlusion textures: building it and fetching from it.
Status addPrefilter(measure::EngineSession& session, const scene::SceneDescription& scene,
                    const InterleavedOptions& options, measure::Json& profile) {
  std::vector<measure::Configuration> configurations;
  for (const char* filter : kPrefilters)
    configurations.push_back({"occlusion-textures", {{"occlusion-textures.filter", filter}}});
  const auto times = interleavedTimes(session, scene, configurations, options);
  if (!times) return times.error();
  if (!times->front().supported) return {};
  measure::Json measured;
  std::string list;
  for (std::size_t i = 0; i < kPrefilters.size(); ++i) {
    const FrameTimes& t = (*times)[i];
    measured[kPrefilters[i]] = t.frame.medianMs;
    list += (i ? ", " : "") + std::string(kPrefilters[i]) + " " + milliseconds(t.frame.medianMs);
  }
  const std::size_t best = times->front().frame.medianMs <= (*times)[1].frame.medianMs ? 0 : 1;
  profile["choices"].push_back(
      {{"setting", "occlusion-textures.filter"},
       {"value", kPrefilters[best]},
       {"ms", measured},
       {"reason", "whole frames with a moving light, " + conditions(options) + list +
                      " ms; mipmaps are out of the choice: their error is larger (penumbra RMSE of "
                      "builtin:leaves@light=1 .074 against .060)"}});
  profile["settings"].push_back({{"key", "occlusion_prefilter"},
                                 {"value", kPrefilters[best]},
                                 {"reason", "least time of a frame that makes and uses it: " +
                                                milliseconds((*times)[best].frame.medianMs) + " ms"}});
  return {};
}

bool has(measure::EngineSession& session, const std::string& capability) {
  for (std::size_t i = 0; i < session.engine().capabilityCount(); ++i) {
    const CapabilityRecord record = session.engine().capability(i);
    if (record.name == capability) return record.available;
  }
  return false;
}

/// What the setting `key` of a technique made from silhouettes is best at, recorded as `profileKey`.
struct RouteChoice {
  const char* technique;
  const char* key;
  const char* profileKey;
  std::vector<const char*> values;
};

/// The same for the ways of combining silhouettes: unchanged frames, since gathering keeps its lists and what
/// moves differs from host to host.
Status addRoute(measure::EngineSession& session, const scene::SceneDescription& scene,
                const InterleavedOptions& options, const RouteChoice& choice, measure::Json& profile) {
  std::vector<measure::Configuration> configurations;
  for (const char* value : choice.values) configurations.push_back({choice.technique, {{choice.key, value}}});
  const auto times = interleavedTimes(session, scene, configurations, options);
  if (!times) return times.error();
  if (!times->front().supported) return {};
  measure::Json measured;
  std::string list;
  std::size_t best = 0;
  for (std::size_t i = 0; i < choice.values.size(); ++i) {
    const FrameTimes& t = (*times)[i];
    measured[choice.values[i]] = t.frameStatic.medianMs;
    list += (i ? ", " : "") + std::string(choice.values[i]) + " " + milliseconds(t.frameStatic.medianMs) +
            " (" + milliseconds(t.frame.medianMs) + ")";
    if (t.frameStatic.medianMs < (*times)[best].frameStatic.medianMs) best = i;
  }
  profile["choices"].push_back(
      {{"setting", choice.key},
       {"value", choice.values[best]},
       {"ms", measured},
       {"reason", "unchanged frames (with a moving light), " + conditions(options) + list + " ms"}});
  profile["settings"].push_back({{"key", choice.profileKey},
                                 {"value", choice.values[best]},
                                 {"reason", "least time of an unchanged frame: " +
                                                milliseconds((*times)[best].frameStatic.medianMs) + " ms"}});
  return {};
}

Status addWedgeRoutes(measure::EngineSession& session, const scene::SceneDescription& scene,
                      const InterleavedOptions& options, measure::Json& profile) {
  RouteChoice choices[] = {{"wedges-cells", "wedges-cells.route", "wedge_route", {"gather", "scatter"}},
                           {"wedges-blended", "wedges-blended.merge", "wedge_merge", {"gather", "core"}}};
  if (has(session, "blend-minmax")) choices[1].values.push_back("minmax");
  if (has(session, "framebuffer-fetch")) {
    for (RouteChoice& choice : choices) choice.values.push_back("fetch");
  }
  for (const RouteChoice& choice : choices) {
    if (Status status = addRoute(session, scene, options, choice, profile); !status) return status;
  }
  return {};
}
}  // namespace

Result<measure::Json> deviceProfile(measure::EngineSession& session, const scene::SceneDescription& scene,
                                    const InterleavedOptions& options) {
  measure::Json profile{{"driver", measure::driverJson(session.engine().driver())},
                        {"settings", measure::Json::array()},
                        {"choices", measure::Json::array()}};
  for (const auto add : {addFilterSkip, addPrefilter, addWedgeRoutes}) {
    if (Status status = add(session, scene, options, profile); !status) return status.error();
  }
  return profile;
}

}  // namespace halfshadow::profile
