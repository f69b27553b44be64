// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Points over two logarithmic axes as inline SVG.
#pragma once

#include <string>
#include <vector>

#include "report/plot_axes.hpp"

namespace halfshadow::report {

struct ScatterPoint {
  std::string label;
  double x = 0.0, y = 0.0;  ///< both > 0; others are left out
};

/// Indices of the points that no other point beats in both, by ascending x. Less is better.
std::vector<std::size_t> paretoFront(const std::vector<ScatterPoint>& points);

/// An <svg> element with grid, labels and the Pareto front; empty when no point can be drawn.
std::string scatterSvg(const std::vector<ScatterPoint>& points, const PlotAxes& axes);

}  // namespace halfshadow::report
