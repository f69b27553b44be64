// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a profile measures, read from a JSON file: profiles/benchmarks/*.json.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "measure/measurement.hpp"

namespace halfshadow::profile {

struct SuiteConfiguration {
  std::string label;  ///< unique: "pcf 7"
  measure::Configuration configuration;
};

/// A scene, and the camera that replaces its own.
struct SuiteScene {
  std::string label;  ///< unique; by default the source
  std::string source, camera;
};

/// The time of one configuration divided by that of another.
struct Ratio {
  std::string of, to;  ///< labels
};

/// The time of one configuration in a scene divided by that of the same one in another scene, both less the
/// time of the configuration `above` (empty: nothing): what a technique adds.
struct SceneRatio {
  std::string configuration, above;  ///< labels of configurations
  std::string of, to;                ///< labels of scenes
};

struct Suite {
  std::string name, description;
  int width = 0, height = 0;
  int samples = 0;      ///< light points per pixel of the truth
  int repetitions = 0;  ///< timed frames of each configuration
  std::vector<SuiteScene> scenes;
  std::vector<SuiteConfiguration> configurations;
  std::vector<Ratio> ratios;
  std::vector<SceneRatio> sceneRatios;
};

/// `nameOrFile`: a .json file, or the name of one in profiles/benchmarks ("quick"), which the tool has in it.
/// Errors: fileNotFound,
/// fileMalformed (which field is missing or wrong).
Result<Suite> readSuite(const std::string& nameOrFile);

}  // namespace halfshadow::profile
