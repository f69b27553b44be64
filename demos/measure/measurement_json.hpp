// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Measurements as JSON, with the field names that `halfshadow measure --json` promises.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "measure/measurement.hpp"

namespace halfshadow::measure {

/// Fields keep the order in which they are written.
using Json = nlohmann::ordered_json;

Json toJson(const metrics::ErrorStatistics& statistics);
Json toJson(const Counters& counters);
Json toJson(const PassMeasurement& pass);
Json toJson(const std::vector<Setting>& settings);
Json toJson(const std::vector<SkipMeasurement>& skips);
/// One entry of "techniques".
Json toJson(const TechniqueMeasurement& measurement);
/// {"vendor", "renderer", "version"}.
Json driverJson(const DriverRecord& driver);
/// {"center", "u", "v"}.
Json lightJson(const scene::AreaLight& light);
/// The whole document.
Json toJson(const scene::SceneDescription& scene, const DriverRecord& driver, const Truth& truth,
            const std::vector<TechniqueMeasurement>& techniques);

}  // namespace halfshadow::measure
