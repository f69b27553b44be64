// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/scatter_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/html.hpp"

namespace halfshadow::report {
namespace {

constexpr double kDotRadius = 5, kLetterWidth = 7.0, kLineHeight = 15;

struct Box {
  double x0, y0, x1, y1;
  bool overlaps(const Box& other) const {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
};

/// Puts each label where it hides no dot and no other label, as far as one of the eight places allows.
std::string labels(const std::vector<ScatterPoint>& points, const LogScale& xScale, const LogScale& yScale) {
  std::vector<Box> taken;
  for (const ScatterPoint& point : points) {
    const double x = xScale(point.x), y = yScale(point.y);
    taken.push_back({x - kDotRadius, y - kDotRadius, x + kDotRadius, y + kDotRadius});
  }
  std::string svg;
  for (const ScatterPoint& point : points) {
    const double x = xScale(point.x), y = yScale(point.y);
    const double width = kLetterWidth * static_cast<double>(point.label.size());
    struct Place {
      double dx, dy;
      const char* anchor;
    };
    constexpr std::array<Place, 8> kPlaces = {{{9, 4, "start"},
                                               {-9, 4, "end"},
                                               {0, -9, "middle"},
                                               {0, 18, "middle"},
                                               {9, -9, "start"},
                                               {9, 17, "start"},
                                               {-9, -9, "end"},
                                               {-9, 17, "end"}}};
    const Place* best = &kPlaces[0];
    Box bestBox{};
    int fewest = std::numeric_limits<int>::max();
    for (const Place& place : kPlaces) {
      const double start = place.anchor[0] == 's'   ? x + place.dx
                           : place.anchor[0] == 'e' ? x + place.dx - width
                                                    : x + place.dx - width / 2;
      const Box box{start, y + place.dy - kLineHeight * 0.75, start + width,
                    y + place.dy + kLineHeight * 0.25};
      int hits =
          box.x0 < kPlotLeft || box.x1 > kPlotWidth - 2 || box.y0 < 2 || box.y1 > kPlotHeight - kPlotBottom
              ? 10
              : 0;
      for (const Box& other : taken) hits += box.overlaps(other) ? 1 : 0;
      if (hits < fewest) {
        fewest = hits;
        best = &place;
        bestBox = box;
      }
    }
    taken.push_back(bestBox);
    svg += svgText(x + best->dx, y + best->dy, best->anchor, point.label, "label");
  }
  return svg;
}

}  // namespace

std::vector<std::size_t> paretoFront(const std::vector<ScatterPoint>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  std::vector<std::size_t> front;
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (points[i].y < lowest) {
      lowest = points[i].y;
      front.push_back(i);
    }
  }
  return front;
}

std::string scatterSvg(const std::vector<ScatterPoint>& allPoints, const PlotAxes& axes) {
  std::vector<ScatterPoint> points;
  for (const ScatterPoint& point : allPoints) {
    if (std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0 && point.y > 0)
      points.push_back(point);
  }
  if (points.empty()) return {};
  LogScale x = horizontalScale(points[0].x), y = verticalScale(points[0].y);
  for (const ScatterPoint& point : points) {
    x.include(point.x);
    y.include(point.y);
  }
  x.widen();
  y.widen();

  std::string svg = plotFrame(x, y, axes);
  const std::vector<std::size_t> front = paretoFront(points);
  std::string path;
  for (const std::size_t i : front) {
    path += (path.empty() ? "M" : " L") + svgNumber(x(points[i].x)) + " " + svgNumber(y(points[i].y));
  }
  svg += "<path class=\"front\" d=\"" + path + "\"/>\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool onFront = std::find(front.begin(), front.end(), i) != front.end();
    svg += "<circle cx=\"" + svgNumber(x(points[i].x)) + "\" cy=\"" + svgNumber(y(points[i].y)) + "\" r=\"" +
           svgNumber(kDotRadius) + "\" class=\"" + (onFront ? "dot on" : "dot") + "\"><title>" +
           escaped(points[i].label + ": " + tickText(points[i].x) + ", " + tickText(points[i].y)) +
           "</title></circle>\n";
  }
  return svg + labels(points, x, y) + "</svg>\n";
}

}  // namespace halfshadow::report
