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
  std::string source;
  measure::Json measurements;  ///< as of `measure --json`
  std::vector<FrameTimes> times;
};

struct RatioResult {
  std::string of, to;
  double frame = 0.0, receiver = 0.0;  ///< time of `of` / time of `to`
};
/// The suite's ratios in one scene; those with an unsupported side are left out.
std::vector<RatioResult> ratiosOf(const Suite& suite, const std::vector<FrameTimes>& times);

measure::Json toJson(const Suite& suite, const std::vector<SceneProfile>& scenes);

}  // namespace halfshadow::profile
