// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/scatter_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "report/html.hpp"

namespace halfshadow::report {
namespace {

constexpr double kWidth = 860, kHeight = 440, kLeft = 64, kRight = 24, kTop = 16, kBottom = 52;
constexpr double kDotRadius = 5, kLetterWidth = 7.0, kLineHeight = 15;

struct Box {
  double x0, y0, x1, y1;
  bool overlaps(const Box& other) const {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
};

/// One logarithmic axis: value to pixel.
struct LogScale {
  double low = 1, high = 10, from = 0, to = 1;
  double operator()(double value) const {
    return from + (to - from) * std::log(value / low) / std::log(high / low);
  }
  /// Grows [low, high] to the nearest of 1, 2, 5 × 10^n, and to a factor of at least four.
  void widen() {
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
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string tickText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string line(double x0, double y0, double x1, double y1, const char* className) {
  return "<line x1=\"" + number(x0) + "\" y1=\"" + number(y0) + "\" x2=\"" + number(x1) + "\" y2=\"" +
         number(y1) + "\" class=\"" + className + "\"/>\n";
}

std::string text(double x, double y, const char* anchor, const std::string& content, const char* className) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\" class=\"" +
         className + "\">" + escaped(content) + "</text>\n";
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
    svg += line(x(value), kTop, x(value), kHeight - kBottom, labelled ? "major" : "minor");
    if (labelled) svg += text(x(value), kHeight - kBottom + 18, "middle", tickText(value), "axis");
  });
  forEachTick(y, [&](double value, bool labelled) {
    svg += line(kLeft, y(value), kWidth - kRight, y(value), labelled ? "major" : "minor");
    if (labelled) svg += text(kLeft - 8, y(value) + 4, "end", tickText(value), "axis");
  });
  return svg;
}

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
      int hits = box.x0 < kLeft || box.x1 > kWidth - 2 || box.y0 < 2 || box.y1 > kHeight - kBottom ? 10 : 0;
      for (const Box& other : taken) hits += box.overlaps(other) ? 1 : 0;
      if (hits < fewest) {
        fewest = hits;
        best = &place;
        bestBox = box;
      }
    }
    taken.push_back(bestBox);
    svg += text(x + best->dx, y + best->dy, best->anchor, point.label, "label");
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

std::string scatterSvg(const std::vector<ScatterPoint>& allPoints, const ScatterAxes& axes) {
  std::vector<ScatterPoint> points;
  for (const ScatterPoint& point : allPoints) {
    if (std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0 && point.y > 0)
      points.push_back(point);
  }
  if (points.empty()) return {};
  LogScale x{points[0].x, points[0].x, kLeft, kWidth - kRight};
  LogScale y{points[0].y, points[0].y, kHeight - kBottom, kTop};
  for (const ScatterPoint& point : points) {
    x.low = std::min(x.low, point.x);
    x.high = std::max(x.high, point.x);
    y.low = std::min(y.low, point.y);
    y.high = std::max(y.high, point.y);
  }
  x.widen();
  y.widen();

  std::string svg = "<svg viewBox=\"0 0 " + number(kWidth) + " " + number(kHeight) +
                    "\" role=\"img\" aria-label=\"" + escaped(axes.yTitle + " over " + axes.xTitle) +
                    "\">\n" + grid(x, y);
  svg += text((kLeft + kWidth - kRight) / 2, kHeight - 12, "middle", axes.xTitle, "axis");
  svg += "<text transform=\"translate(16 " + number((kTop + kHeight - kBottom) / 2) +
         ") rotate(-90)\" text-anchor=\"middle\" class=\"axis\">" + escaped(axes.yTitle) + "</text>\n";
  const std::vector<std::size_t> front = paretoFront(points);
  std::string path;
  for (const std::size_t i : front) {
    path += (path.empty() ? "M" : " L") + number(x(points[i].x)) + " " + number(y(points[i].y));
  }
  svg += "<path class=\"front\" d=\"" + path + "\"/>\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool onFront = std::find(front.begin(), front.end(), i) != front.end();
    svg += "<circle cx=\"" + number(x(points[i].x)) + "\" cy=\"" + number(y(points[i].y)) + "\" r=\"" +
           number(kDotRadius) + "\" class=\"" + (onFront ? "dot on" : "dot") + "\"><title>" +
           escaped(points[i].label + ": " + tickText(points[i].x) + ", " + tickText(points[i].y)) +
           "</title></circle>\n";
  }
  return svg + labels(points, x, y) + "</svg>\n";
}

}  // namespace halfshadow::report
