// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/light_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/light_space.hpp"

namespace halfshadow::planner {
namespace {

// Extents and depths move in these steps: coarse enough that a moving caster rarely changes the mapping, fine
// enough that at most 4.4 % of the map is wasted.
constexpr double kStepsPerOctave = 16.0;
// Gap between the casters and the depth range's ends, relative: 64 quanta of a 16-bit map whose range is one
// octave, so that no caster is stored as 0 or 1 (1 means "nothing here").
constexpr double kDepthMargin = 1.0 / 1024;
// Casters that are smaller seen from the light than this would make the texel size vanish.
constexpr double kMinTangentExtent = 1e-6;

double stepUp(double value) {
  return std::exp2(std::ceil(std::log2(value) * kStepsPerOctave) / kStepsPerOctave);
}
double stepDown(double value) {
  return std::exp2(std::floor(std::log2(value) * kStepsPerOctave) / kStepsPerOctave);
}

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) { low = std::min(low, value), high = std::max(high, value); }
};

struct DepthRange {
  double nearDistance, farDistance;
};

// `nearest` is 0 when a caster crosses the light's plane.
DepthRange fitDepth(double nearest, double farthest, double minNearShare) {
  const double limit = minNearShare * farthest;
  double nearDistance = nearest > 0.0 ? stepDown(nearest * (1.0 - kDepthMargin)) : 0.0;
  if (nearDistance < limit) {
    // A stepped limit, unless it would cut a caster that the limit itself lets through.
    nearDistance = std::min(stepUp(limit), std::max(limit, nearest * (1.0 - kDepthMargin)));
  }
  return {nearDistance, stepUp(farthest * (1.0 + kDepthMargin))};
}

// Smallest interval of whole steps that holds `tangents` and the border; the origin is a whole texel.
Interval snapTangents(const Interval& tangents, int mapSize, int borderTexels) {
  // The origin is rounded down by up to one texel on top of the border on each side.
  const double usableShare = std::max(1, mapSize - 2 * borderTexels - 1) / static_cast<double>(mapSize);
  const double extent = stepUp(std::max(tangents.high - tangents.low, kMinTangentExtent) / usableShare);
  const double texel = extent / mapSize;
  const double low = (std::floor(tangents.low / texel) - borderTexels) * texel;
  return {low, low + extent};
}

// Tangents along one axis (0 = x, 1 = y): of all points where they all lie before the light, else of their
// part beyond `nearDistance`. Points are not joined to casters, so a point behind the light may belong to any
// of them: wherever a caster is cut, it is cut inside the box of all points. `spread`: see
// LightFitOptions::centerSpread.
Interval fitTangents(const std::vector<glm::dvec3>& pointsLight, int axis, double nearest,
                     const DepthRange& depth, double spread) {
  const double nearDistance = depth.nearDistance;
  Interval tangents, lateral;
  const auto include = [&](double side, double z) {
    const double shift = spread * std::abs(1.0 / z - 1.0 / depth.farDistance);
    tangents.include(side / z - shift);
    tangents.include(side / z + shift);
  };
  bool cut = false;
  for (const glm::dvec3& point : pointsLight) {
    lateral.include(point[axis]);
    if (nearest > 0.0 || point.z >= nearDistance) {
      include(point[axis], point.z);
    } else {
      cut = true;
    }
  }
  if (cut) {
    include(lateral.low, nearDistance);
    include(lateral.high, nearDistance);
  }
  return tangents;
}

/// The part of a convex polygon on the inner side of sign * axis <= sign * limit.
void clipPolygon(std::vector<glm::dvec3>& polygon, int axis, double sign, double limit) {
  std::vector<glm::dvec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& from = polygon[i];
    const glm::dvec3& to = polygon[(i + 1) % polygon.size()];
    const double a = sign * (limit - from[axis]), b = sign * (limit - to[axis]);
    if (a >= 0.0) kept.push_back(from);
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) kept.push_back(from + (to - from) * (a / (a - b)));
  }
  polygon = std::move(kept);
}

/// Whether a triangle, three points each, has a part of positive extent inside the box or on its sides, other
/// than in its lowest plane: what lies in the light's own plane shadows nothing.
bool anyTriangleWithin(const std::vector<glm::dvec3>& points, const glm::dvec3& low, const glm::dvec3& high) {
  std::vector<glm::dvec3> polygon;
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    const glm::dvec3 least = glm::min(points[i], glm::min(points[i + 1], points[i + 2]));
    const glm::dvec3 most = glm::max(points[i], glm::max(points[i + 1], points[i + 2]));
    if (most.z <= low.z || glm::any(glm::lessThan(most, low)) || glm::any(glm::greaterThan(least, high)))
      continue;
    polygon.assign(points.begin() + static_cast<std::ptrdiff_t>(i),
                   points.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    for (int axis = 0; axis < 3 && !polygon.empty(); ++axis) {
      clipPolygon(polygon, axis, 1.0, high[axis]);
      clipPolygon(polygon, axis, -1.0, low[axis]);
    }
    if (std::ranges::any_of(polygon, [&](const glm::dvec3& p) { return p.z > low.z; })) return true;
  }
  return false;
}

}  // namespace

glm::dmat4 LightFit::clipFromLight() const {
  const glm::dvec2 extent = tangentHigh - tangentLow, sum = tangentHigh + tangentLow;
  // storedDepth = a - b / z
  const double a = farDistance / (farDistance - nearDistance), b = a * nearDistance;
  glm::dmat4 m(0.0);
  m[0][0] = 2.0 / extent.x;
  m[1][1] = 2.0 / extent.y;
  m[2] = glm::dvec4(-sum.x / extent.x, -sum.y / extent.y, 2.0 * a - 1.0, 1.0);
  m[3][2] = -2.0 * b;
  return m;
}

double LightFit::storedDepth(double z) const {
  return (1.0 / nearDistance - 1.0 / z) / (1.0 / nearDistance - 1.0 / farDistance);
}

LightFit fitLight(const scene::AreaLight& light, std::span<const glm::dvec3> casterPointsWorld,
                  const LightFitOptions& options) {
  const LightSpace space = lightSpace(light);
  LightFit fit{.lightFromWorld = space.matrix(), .halfSize = space.halfSize, .mapSize = options.mapSize};
  std::vector<glm::dvec3> pointsLight;
  pointsLight.reserve(casterPointsWorld.size());
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (const glm::dvec3& point : casterPointsWorld) {
    pointsLight.push_back(space.lightFromWorld(point));
    nearest = std::min(nearest, pointsLight.back().z);
    farthest = std::max(farthest, pointsLight.back().z);
  }
  if (!(farthest > 0.0)) return fit;
  if (options.pointsAreTriangles) {
    const double distance = options.nearShare * 2.0 * std::max(fit.halfSize.x, fit.halfSize.y);
    fit.casterNearLight = anyTriangleWithin(pointsLight, glm::dvec3(-fit.halfSize - distance, 0.0),
                                            glm::dvec3(fit.halfSize + distance, distance));
  }
  const DepthRange depth = fitDepth(std::max(nearest, 0.0), farthest, options.minNearShare);
  fit.nearDistance = depth.nearDistance;
  fit.farDistance = depth.farDistance;
  fit.nearestCaster = std::max(nearest, depth.nearDistance);
  fit.farthestCaster = farthest;
  fit.castersBeforeNear = nearest < depth.nearDistance;
  fit.castersCrossPlane = !(nearest > 0.0);
  for (int axis = 0; axis < 2; ++axis) {
    Interval tangents = fitTangents(pointsLight, axis, nearest, depth, options.centerSpread[axis]);
    if (tangents.low > options.maxTangent || tangents.high < -options.maxTangent) return fit;
    tangents = {std::max(tangents.low, -options.maxTangent), std::min(tangents.high, options.maxTangent)};
    const Interval snapped = snapTangents(tangents, options.mapSize, options.borderTexels);
    fit.tangentLow[axis] = snapped.low;
    fit.tangentHigh[axis] = snapped.high;
  }
  fit.empty = false;
  return fit;
}

}  // namespace halfshadow::planner
