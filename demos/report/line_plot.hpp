// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Curves over two logarithmic axes as inline SVG.
#pragma once

#include <string>
#include <vector>

#include "report/plot_axes.hpp"

namespace halfshadow::report {

struct PlotPoint {
  double x = 0.0, y = 0.0;  ///< both > 0; others are left out
};

struct Curve {
  std::string label;  ///< written at the curve's end
  std::vector<PlotPoint> points;
};

/// An <svg> element with grid, curves, dots and labels; empty when no point can be drawn. Colours repeat from
/// the ninth curve on.
std::string lineSvg(const std::vector<Curve>& curves, const PlotAxes& axes);

}  // namespace halfshadow::report
