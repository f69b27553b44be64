// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The table as a part of the report's page.
#pragma once

#include "report/section.hpp"
#include "stress/run.hpp"

namespace halfshadow::stress {

/// The verdicts, how cases are judged, and what is not ok.
report::Section section(const Table& table, const Options& options);

}  // namespace halfshadow::stress
