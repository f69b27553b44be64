// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A suite's results as JSON.
#pragma once

#include "measure/measurement_json.hpp"
#include "profile/interleaved.hpp"
#include "profile/suite.hpp"

namespace halfshadow::profile {

/// One scene's results; the vectors have the order of the suite's configurations.
struct SceneProfile {
  std::string label;
  measure::Json measurements;  ///< as of `measure --json`
  std::vector<FrameTimes> times;
};

/// Quotients of medians; 0 where the divisor is too short to be told from nothing.
struct TimeRatios {
  double frame = 0.0, receiver = 0.0;         ///< dynamic frames; their receiver passes
  double unchanged = 0.0;                     ///< frames in which nothing changed
  double frameCpu = 0.0, unchangedCpu = 0.0;  ///< processor time
};
struct RatioResult {
  std::string of, to;
  TimeRatios times;
};
/// The suite's ratios in one scene; those with an unsupported side are left out.
std::vector<RatioResult> ratiosOf(const Suite& suite, const std::vector<FrameTimes>& times);

struct SceneRatioResult {
  SceneRatio ratio;
  TimeRatios times;
};
/// The suite's ratios between scenes; `scenes` has the suite's order.
std::vector<SceneRatioResult> sceneRatiosOf(const Suite& suite, const std::vector<SceneProfile>& scenes);

measure::Json toJson(const Suite& suite, const std::vector<SceneProfile>& scenes);

}  // namespace halfshadow::profile
