// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/line_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "report/html.hpp"

namespace halfshadow::report {
namespace {

constexpr int kColors = 8;
/// Between baselines of labels.
constexpr double kLabelHeight = 16;

bool drawable(const PlotPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0 && point.y > 0;
}

struct Label {
  double x = 0, y = 0;
  std::string text, className;
};

/// Labels stand left of their curve's end, above it, and are pushed apart from the lowest up.
std::string endLabels(std::vector<Label> labels) {
  std::ranges::sort(labels, [](const Label& a, const Label& b) { return a.y > b.y; });
  double lowest = std::numeric_limits<double>::infinity();
  std::string svg;
  for (Label& label : labels) {
    label.y = std::max(std::min(label.y - 8, lowest - kLabelHeight), kPlotTop + 10);
    lowest = label.y;
    svg += svgText(label.x - 8, label.y, "end", label.text, label.className);
  }
  return svg;
}

}  // namespace

std::string lineSvg(const std::vector<Curve>& curves, const PlotAxes& axes) {
  std::optional<LogScale> xScale, yScale;
  for (const Curve& curve : curves) {
    for (const PlotPoint& point : curve.points) {
      if (!drawable(point)) continue;
      if (!xScale) {
        xScale = horizontalScale(point.x);
        yScale = verticalScale(point.y);
      }
      xScale->include(point.x);
      yScale->include(point.y);
    }
  }
  if (!xScale) return {};
  xScale->widen();
  yScale->widen();
  std::string svg = plotFrame(*xScale, *yScale, axes);
  std::vector<Label> labels;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string color = " c" + std::to_string(i % kColors);
    std::string path, dots;
    Label label{.text = curves[i].label, .className = "label" + color};
    for (const PlotPoint& point : curves[i].points) {
      if (!drawable(point)) continue;
      label.x = (*xScale)(point.x);
      label.y = (*yScale)(point.y);
      const std::string x = svgNumber(label.x), y = svgNumber(label.y);
      path += (path.empty() ? "M" : " L") + x + " " + y;
      dots += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"3.5\" class=\"point" + color + "\"><title>" +
              escaped(curves[i].label + ": " + tickText(point.x) + ", " + tickText(point.y)) +
              "</title></circle>\n";
    }
    if (path.empty()) continue;
    svg += "<path class=\"curve" + color + "\" d=\"" + path + "\"/>\n" + dots;
    labels.push_back(std::move(label));
  }
  return svg + endLabels(std::move(labels)) + "</svg>\n";
}

}  // namespace halfshadow::report
