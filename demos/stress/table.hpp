// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The table as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "measure/measurement_json.hpp"
#include "stress/run.hpp"

namespace halfshadow::stress {

/// A row per case, a column per technique, the gravest verdict in each. The first two rows are the heads:
/// ids are cut at their first hyphen.
std::vector<std::vector<std::string>> summaryRows(const Table& table);

/// What is not ok, one line for each technique and variant: "case/variant technique: verdict: reason".
std::vector<std::string> remarks(const Table& table);

/// "614 ok, 3 fell back, 1 refused, 20 worse, 4 wrong".
std::string countsText(const Table& table);

measure::Json toJson(const Table& table, const Options& options, const DriverRecord& driver);

}  // namespace halfshadow::stress
