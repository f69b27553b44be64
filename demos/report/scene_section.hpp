// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// One scene's part of the page.
#pragma once

#include <string>
#include <vector>

#include "report/report.hpp"

namespace halfshadow::report {

/// A name for each measurement: its id, and for an id that occurs more than once the values of the settings
/// that differ ("pcf 7").
std::vector<std::string> configurationLabels(const std::vector<measure::TechniqueMeasurement>& techniques);

/// Errors: invalidArgument (an image is not of the scene's size).
Result<std::string> sceneSection(const SceneReport& scene, const std::string& anchor);

}  // namespace halfshadow::report
