// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/plot_axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "report/html.hpp"

namespace halfshadow::report {
namespace {

std::string line(double x0, double y0, double x1, double y1, const char* className) {
  return "<line x1=\"" + svgNumber(x0) + "\" y1=\"" + svgNumber(y0) + "\" x2=\"" + svgNumber(x1) +
         "\" y2=\"" + svgNumber(y1) + "\" class=\"" + className + "\"/>\n";
}

/// Calls `visit(value, labelled)` for every 1 … 9 × 10^n within the scale.
template <typename Visit>
void forEachTick(const LogScale& scale, Visit&& visit) {
  const int first = static_cast<int>(std::floor(std::log10(scale.low)));
  const int last = static_cast<int>(std::ceil(std::log10(scale.high)));
  for (int decade = first; decade <= last; ++decade) {
    for (int step = 1; step <= 9; ++step) {
      const double value = step * std::pow(10.0, decade);
      if (value < scale.low * (1 - 1e-9) || value > scale.high * (1 + 1e-9)) continue;
      visit(value, step == 1 || step == 2 || step == 5);
    }
  }
}

std::string grid(const LogScale& x, const LogScale& y) {
  std::string svg;
  forEachTick(x, [&](double value, bool labelled) {
    svg += line(x(value), kPlotTop, x(value), kPlotHeight - kPlotBottom, labelled ? "major" : "minor");
    if (labelled) svg += svgText(x(value), kPlotHeight - kPlotBottom + 18, "middle", tickText(value), "axis");
  });
  forEachTick(y, [&](double value, bool labelled) {
    svg += line(kPlotLeft, y(value), kPlotWidth - kPlotRight, y(value), labelled ? "major" : "minor");
    if (labelled) svg += svgText(kPlotLeft - 8, y(value) + 4, "end", tickText(value), "axis");
  });
  return svg;
}

}  // namespace

double LogScale::operator()(double value) const {
  return from + (to - from) * std::log(value / low) / std::log(high / low);
}

void LogScale::include(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
}

void LogScale::widen() {
  constexpr std::array<double, 3> kSteps = {1, 2, 5};
  const auto stepDown = [&](double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    double best = decade;
    for (const double step : kSteps) {
      if (step * decade <= value * (1 + 1e-9)) best = step * decade;
    }
    return best;
  };
  low = stepDown(low / 1.15);
  high = 1.0 / stepDown(1.0 / (high * 1.15));
  if (high / low < 4) {
    const double middle = std::sqrt(low * high);
    low = middle / 2;
    high = middle * 2;
  }
}

LogScale horizontalScale(double x) {
  return {x, x, kPlotLeft, kPlotWidth - kPlotRight};
}

LogScale verticalScale(double y) {
  return {y, y, kPlotHeight - kPlotBottom, kPlotTop};
}

std::string svgNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string tickText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string svgText(double x, double y, const char* anchor, const std::string& content,
                    const std::string& className) {
  return "<text x=\"" + svgNumber(x) + "\" y=\"" + svgNumber(y) + "\" text-anchor=\"" + anchor +
         "\" class=\"" + className + "\">" + escaped(content) + "</text>\n";
}

std::string plotFrame(const LogScale& x, const LogScale& y, const PlotAxes& axes) {
  std::string svg = "<svg viewBox=\"0 0 " + svgNumber(kPlotWidth) + " " + svgNumber(kPlotHeight) +
                    "\" role=\"img\" aria-label=\"" + escaped(axes.yTitle + " over " + axes.xTitle) +
                    "\">\n" + grid(x, y);
  svg += svgText((kPlotLeft + kPlotWidth - kPlotRight) / 2, kPlotHeight - 12, "middle", axes.xTitle, "axis");
  return svg + "<text transform=\"translate(16 " + svgNumber((kPlotTop + kPlotHeight - kPlotBottom) / 2) +
         ") rotate(-90)\" text-anchor=\"middle\" class=\"axis\">" + escaped(axes.yTitle) + "</text>\n";
}

}  // namespace halfshadow::report
