// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Logarithmic axes as SVG: what the plots share.
#pragma once

#include <string>

namespace halfshadow::report {

struct PlotAxes {
  std::string xTitle, yTitle;
};

/// Size and margins of a plot, SVG units.
inline constexpr double kPlotWidth = 860, kPlotHeight = 440;
inline constexpr double kPlotLeft = 64, kPlotRight = 24, kPlotTop = 16, kPlotBottom = 52;

/// One logarithmic axis: value to SVG units.
struct LogScale {
  double low = 1, high = 10, from = 0, to = 1;
  double operator()(double value) const;
  void include(double value);
  /// Grows [low, high] to the nearest of 1, 2, 5 × 10^n, and to a factor of at least four.
  void widen();
};
/// Scales that hold the point (x, y), over the plot's area.
LogScale horizontalScale(double x);
LogScale verticalScale(double y);

std::string svgNumber(double value);
/// Four significant digits.
std::string tickText(double value);
/// `anchor`: "start", "middle" or "end".
std::string svgText(double x, double y, const char* anchor, const std::string& content,
                    const std::string& className);

/// The opening <svg> tag with grid, tick labels and titles.
std::string plotFrame(const LogScale& x, const LogScale& y, const PlotAxes& axes);

}  // namespace halfshadow::report
