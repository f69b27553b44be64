// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where --json goes.
#pragma once

#include <string>

#include "base/error.hpp"
#include "measure/measurement_json.hpp"

namespace halfshadow::cli {

using measure::Json;

/// Whether the human-readable text may go to standard output: not when JSON does.
bool printsText(const std::string& jsonPath);
/// Before the work: can the file be written? True for "" and "-".
Status checkJsonPath(const std::string& jsonPath);
/// Writes nothing for "", to standard output for "-", else the file, whole or not at all.
Status writeJson(const std::string& jsonPath, const Json& json);

}  // namespace halfshadow::cli
