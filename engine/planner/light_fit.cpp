// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/light_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
  double low, high;
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

/// The next of even steps from `farthest` on: an eighth of the casters' range or less, which for a sun is a
/// small part of their distance, and the light's size halved or doubled, which is the same in whatever units.
double alignedDistance(const LightSpace& space, double nearest, double farthest) {
  const double size = std::max(space.halfSize.x, space.halfSize.y);
  if (!(size > 0.0)) return farthest;
  const double range = std::max(farthest - nearest, 1e-6 * farthest);
  const double step = size * std::exp2(std::floor(std::log2(range / size))) / 8.0;
  return std::ceil(farthest / step) * step;
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

/// Whether a triangle of the caster has a part of positive extent inside the box or on its sides, other than
/// in its lowest plane: what lies in the light's own plane shadows nothing.
bool anyTriangleWithin(const CasterShape& caster, const LightSpace& space, const glm::dvec3& low,
                       const glm::dvec3& high) {
  const scene::TriangleMesh& mesh = *caster.mesh;
  std::vector<glm::dvec3> polygon;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    polygon.clear();
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 position(mesh.positions[mesh.indices[3 * t + k]]);
      polygon.push_back(
          space.lightFromWorld(glm::dvec3(*caster.worldFromObject * glm::dvec4(position, 1.0))));
    }
    const glm::dvec3 least = glm::min(polygon[0], glm::min(polygon[1], polygon[2]));
    const glm::dvec3 most = glm::max(polygon[0], glm::max(polygon[1], polygon[2]));
    if (most.z <= low.z || glm::any(glm::lessThan(most, low)) || glm::any(glm::greaterThan(least, high)))
      continue;
    for (int axis = 0; axis < 3 && !polygon.empty(); ++axis) {
      clipPolygon(polygon, axis, 1.0, high[axis]);
      clipPolygon(polygon, axis, -1.0, low[axis]);
    }
    if (std::ranges::any_of(polygon, [&](const glm::dvec3& p) { return p.z > low.z; })) return true;
  }
  return false;
}

bool sameSpace(const LightSpace& a, const LightSpace& b) {
  return a.originWorld == b.originWorld && a.axisX == b.axisX && a.axisY == b.axisY && a.axisZ == b.axisZ &&
         a.halfSize == b.halfSize;
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

LightFitter::Extent LightFitter::extentOf(const CasterShape& caster) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extent extent{.id = caster.id, .revision = caster.revision};
  glm::dvec3 low(kInfinity), high(-kInfinity);
  extent.tangentLow = glm::dvec2(kInfinity), extent.tangentHigh = glm::dvec2(-kInfinity);
  for (const glm::dvec3& world : caster.pointsWorld) {
    const glm::dvec3 point = space_.lightFromWorld(world);
    low = glm::min(low, point), high = glm::max(high, point);
    extent.tangentLow = glm::min(extent.tangentLow, (glm::dvec2(point) - centerSpread_) / point.z);
    extent.tangentHigh = glm::max(extent.tangentHigh, (glm::dvec2(point) + centerSpread_) / point.z);
  }
  extent.nearest = low.z, extent.farthest = high.z;
  extent.low = glm::dvec2(low), extent.high = glm::dvec2(high);
  const glm::dvec3 nearLow(-space_.halfSize - nearLightDistance_, 0.0),
      nearHigh(space_.halfSize + nearLightDistance_, nearLightDistance_);
  // Triangles are looked at where the box comes near enough.
  extent.nearLight = nearLightDistance_ > 0.0 && caster.mesh != nullptr && high.z > nearLow.z &&
                     glm::all(glm::greaterThanEqual(high, nearLow)) &&
                     glm::all(glm::lessThanEqual(low, nearHigh)) &&
                     anyTriangleWithin(caster, space_, nearLow, nearHigh);
  return extent;
}

void LightFitter::measure(std::span<const CasterShape> casters, const ListChanges& changes) {
  if (const auto places = changes.since(seen_)) {
    for (const std::uint32_t place : places.places) {
      extents_[place] = extentOf(casters[place]);
      totals_.changed(place);
      ++castersMeasured_;
    }
    return;
  }
  // Those of the frame before stay where they are, while they are the same.
  std::size_t same = 0;
  const std::size_t common = std::min(extents_.size(), casters.size());
  for (; same < common && extents_[same].id == casters[same].id; ++same) {
    if (extents_[same].revision == casters[same].revision) continue;
    extents_[same] = extentOf(casters[same]);
    totals_.changed(same);
    ++castersMeasured_;
  }
  if (same == extents_.size() && same == casters.size()) return;
  totals_.forget();
  before_.assign(extents_.begin() + static_cast<std::ptrdiff_t>(same), extents_.end());
  extents_.resize(same);
  auto known = before_.begin();
  for (const CasterShape& caster : casters.subspan(same)) {
    // Casters come in the order of their ids; what is in another order is measured again.
    while (known != before_.end() && known->id < caster.id) ++known;
    if (known != before_.end() && known->id == caster.id && known->revision == caster.revision) {
      extents_.push_back(*known++);
    } else {
      extents_.push_back(extentOf(caster));
      ++castersMeasured_;
    }
  }
}

template <typename Part>
void LightFitter::Total::include(const Part& part) {
  nearest = std::min(nearest, part.nearest), farthest = std::max(farthest, part.farthest);
  tangentLow = glm::min(tangentLow, part.tangentLow), tangentHigh = glm::max(tangentHigh, part.tangentHigh);
  nearLight = nearLight || part.nearLight;
}

/// Where casters reach behind the near distance: of their part beyond it. Points are not joined to triangles,
/// so a point behind the light may belong to any of them: wherever a caster is cut, it is cut inside the box
/// of all points. See LightFitOptions::centerSpread.
void LightFitter::fitCutTangents(std::span<const CasterShape> casters, double nearDistance, glm::dvec2& low,
                                 glm::dvec2& high) const {
  const auto include = [&](const glm::dvec2& side, double z) {
    low = glm::min(low, (side - centerSpread_) / z), high = glm::max(high, (side + centerSpread_) / z);
  };
  glm::dvec2 boxLow(std::numeric_limits<double>::infinity()), boxHigh = -boxLow;
  bool anyCut = false;
  for (std::size_t i = 0; i < extents_.size(); ++i) {
    const Extent& extent = extents_[i];
    boxLow = glm::min(boxLow, extent.low), boxHigh = glm::max(boxHigh, extent.high);
    if (extent.nearest >= nearDistance) {
      low = glm::min(low, extent.tangentLow), high = glm::max(high, extent.tangentHigh);
      continue;
    }
    anyCut = true;
    for (const glm::dvec3& world : casters[i].pointsWorld) {
      const glm::dvec3 point = space_.lightFromWorld(world);
      if (point.z >= nearDistance) include(glm::dvec2(point), point.z);
    }
  }
  if (anyCut) include(boxLow, nearDistance);
  if (anyCut) include(boxHigh, nearDistance);
}

LightFit LightFitter::fit(const scene::AreaLight& light, std::span<const CasterShape> casters,
                          const LightFitOptions& options, const ListChanges& changes) {
  const LightSpace space = lightSpace(light);
  const double nearLightDistance = options.nearShare * 2.0 * std::max(space.halfSize.x, space.halfSize.y);
  if (!sameSpace(space, space_) || nearLightDistance != nearLightDistance_ ||
      options.centerSpread != centerSpread_) {
    extents_.clear();
    totals_.forget();
    seen_ = 0;
  }
  centerSpread_ = options.centerSpread;
  space_ = space;
  nearLightDistance_ = nearLightDistance;
  measure(casters, changes);
  seen_ = changes.revision;
  LightFit fit{.lightFromWorld = space.matrix(), .halfSize = space.halfSize, .mapSize = options.mapSize};
  const Total total = totals_.total(
      extents_.size(), [&](Total& part, std::size_t place) { part.include(extents_[place]); },
      [](Total& all, const Total& part) { all.include(part); });
  const double nearest = total.nearest, farthest = total.farthest;
  if (!(farthest > 0.0)) return fit;
  fit.casterNearLight = total.nearLight;
  const DepthRange depth = fitDepth(std::max(nearest, 0.0), farthest, options.minNearShare);
  fit.nearDistance = depth.nearDistance;
  fit.farDistance = depth.farDistance;
  fit.alignedDistance = alignedDistance(space, std::max(nearest, depth.nearDistance), farthest);
  fit.nearestCaster = std::max(nearest, depth.nearDistance);
  fit.farthestCaster = farthest;
  fit.castersBeforeNear = nearest < depth.nearDistance;
  fit.castersCrossPlane = !(nearest > 0.0);
  glm::dvec2 low = total.tangentLow, high = total.tangentHigh;
  if (fit.castersCrossPlane) {
    low = glm::dvec2(std::numeric_limits<double>::infinity()), high = -low;
    fitCutTangents(casters, depth.nearDistance, low, high);
  }
  // Nothing lies beyond the distance where all centres agree.
  low += centerSpread_ / fit.alignedDistance, high -= centerSpread_ / fit.alignedDistance;
  const glm::dvec2 most(options.maxTangent);
  if (glm::any(glm::greaterThan(low, most)) || glm::any(glm::lessThan(high, -most))) return fit;
  low = glm::max(low, -most), high = glm::min(high, most);
  const double widest = std::max(high.x - low.x, high.y - low.y);
  for (double wide = options.wideWindow; wide < widest && 2 * fit.mapSize <= options.mostMapSize; wide *= 2.0)
    fit.mapSize *= 2, fit.growth *= 2;
  for (int axis = 0; axis < 2; ++axis) {
    const Interval snapped = snapTangents({low[axis], high[axis]}, fit.mapSize, options.borderTexels);
    fit.tangentLow[axis] = snapped.low;
    fit.tangentHigh[axis] = snapped.high;
  }
  fit.empty = false;
  return fit;
}

LightFit fitLight(const scene::AreaLight& light, std::span<const CasterShape> casters,
                  const LightFitOptions& options) {
  return LightFitter().fit(light, casters, options);
}

LightFit fitLight(const scene::AreaLight& light, std::span<const glm::dvec3> pointsWorld,
                  const LightFitOptions& options) {
  const CasterShape all{.pointsWorld = pointsWorld};
  return fitLight(light, {&all, 1}, options);
}

}  // namespace halfshadow::planner
