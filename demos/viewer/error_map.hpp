// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The error of a visibility image against truth: as numbers and as colours.
#pragma once

#include <cstdint>
#include <vector>

#include "metrics/metrics.hpp"
#include "viewer/truth_worker.hpp"

namespace halfshadow::viewer {

struct ErrorMap {
  metrics::ErrorStatistics statistics;  ///< over receivers
  std::vector<std::uint8_t> rgba;       ///< width × height × 4, row 0 on top
};

/// Colour of an error, `full` and beyond at the end of the scale: too bright goes to red over yellow, too
/// dark to blue over cyan, none is black.
struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
};
Colour errorColour(double error, double full);

/// `measured` has one value per pixel of the truth.
ErrorMap errorMap(const std::vector<float>& measured, const TruthImage& truth, double full);

}  // namespace halfshadow::viewer
