// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Configurations side by side: errors against one truth and times taken in turn.
#pragma once

#include <string>
#include <vector>

#include "measure/measurement.hpp"
#include "papers/papers.hpp"
#include "profile/interleaved.hpp"

namespace halfshadow::papers {

struct Variant {
  std::string label;
  measure::Configuration configuration;
};

/// The variants that this engine can run, and a sentence for each of the others.
struct Available {
  std::vector<Variant> variants;
  std::vector<std::string> leftOut;
};
Available availableOf(measure::EngineSession& session, const std::vector<Variant>& variants);

struct ComparedVariant {
  Variant variant;
  measure::TechniqueMeasurement measurement;
  profile::FrameTimes times;
};

struct Comparison {
  std::string source;
  scenes::ViewCommand view;  ///< opens the scene as it was drawn; without technique
  measure::Truth truth;
  std::vector<ComparedVariant> variants;
};

/// Errors: those of openScene, traceTruth, measureTechnique and interleavedTimes.
Result<Comparison> compare(measure::EngineSession& session, const std::string& source,
                           const std::vector<Variant>& variants, const PaperOptions& options);

/// Penumbra RMSE of all receivers and of the ground, p99, largest error.
std::string errorText(const measure::TechniqueMeasurement& measurement);
/// Cards for `count` variants from `first` on.
Result<std::string> picturesOf(const Comparison& comparison, std::size_t first = 0,
                               std::size_t count = static_cast<std::size_t>(-1));
/// "320x240 pixels; times are medians of 3 frames."
std::string conditionsText(const PaperOptions& options);
/// {"scene", "size", "truth", "variants": [{"label", "technique", "error", "time_ms", …, "passes"}]}.
measure::Json toJson(const Comparison& comparison);
/// "Left out: …" or nothing.
void noteLeftOut(report::Section& section, const std::vector<std::string>& leftOut);

}  // namespace halfshadow::papers
