// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/frame_planner.hpp"
#include "planner/light_space.hpp"

namespace halfshadow::planner {
namespace {

// Shares of the largest coordinate that comparisons give away, so that rounding never drops a shadow.
constexpr double kSlack = 1e-9;

double largestCoordinate(const scene::Bounds& bounds) {
  const glm::dvec3 size = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return std::max({size.x, size.y, size.z});
}

// The ray from light point l through caster point c reaches depth r_z at l + (c - l) s with s = r_z / c_z
// >= 1.
struct StretchRange {
  double low = 1.0, high = 1.0;  // of s; high may be infinite
};

// Can a ray meet the receiver's interval along one axis? Over l in [-halfSize, halfSize], c in the caster's
// interval, the largest coordinate is s c + (s - 1) halfSize, linear in s, so its extremes are at the ends.
bool axisMeets(double halfSize, double casterLow, double casterHigh, double receiverLow, double receiverHigh,
               const StretchRange& stretch, double slack) {
  const auto farEnd = [&](double slope, double atLow) {
    if (std::isfinite(stretch.high)) return slope * stretch.high - halfSize;
    return slope > 0.0 ? std::numeric_limits<double>::infinity() : atLow;
  };
  const double highSlope = casterHigh + halfSize, highAtLow = highSlope * stretch.low - halfSize;
  const double lowSlope = -casterLow + halfSize, lowAtLow = lowSlope * stretch.low - halfSize;
  const double high = std::max(highAtLow, farEnd(highSlope, highAtLow));
  const double negativeLow = std::max(lowAtLow, farEnd(lowSlope, lowAtLow));
  return receiverLow <= high + slack && -receiverHigh <= negativeLow + slack;
}

// Corners relative to the light's centre, world axes.
struct Shapes {
  std::array<glm::dvec3, 4> light;
  std::array<glm::dvec3, 8> caster, receiver;
  double longestStretch = 0.0;  // largest (s - 1)
  double slack = 0.0;
};

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
};

template <std::size_t count>
Extent extentAlong(const std::array<glm::dvec3, count>& points, const glm::dvec3& direction) {
  Extent extent;
  for (const glm::dvec3& point : points) {
    const double at = glm::dot(point, direction);
    extent.low = std::min(extent.low, at), extent.high = std::max(extent.high, at);
  }
  return extent;
}

// A shadow point is c + (s - 1)(c - l): along `direction` it is at most max c + longestStretch max(0, max c -
// min l).
bool separates(const Shapes& shapes, const glm::dvec3& direction) {
  const Extent caster = extentAlong(shapes.caster, direction);
  const Extent light = extentAlong(shapes.light, direction);
  const Extent receiver = extentAlong(shapes.receiver, direction);
  const auto beyond = [&](double casterHigh, double lightLow, double receiverLow) {
    const double rise = std::max(0.0, casterHigh - lightLow);
    const double reach = rise > 0.0 ? rise * shapes.longestStretch : 0.0;
    return receiverLow > casterHigh + reach + shapes.slack;
  };
  return beyond(caster.high, light.low, receiver.low) || beyond(-caster.low, -light.high, -receiver.high);
}

// Planes that touch the light and the caster along an edge of one and a corner of the other bound the shadow
// region sideways.
bool tangentPlaneSeparates(const Shapes& shapes, const scene::AreaLight& light) {
  const std::array<glm::dvec3, 5> edges{glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1},
                                        light.halfU, light.halfV};
  for (const glm::dvec3& edge : edges) {
    for (const glm::dvec3& caster : shapes.caster) {
      for (const glm::dvec3& corner : shapes.light) {
        const glm::dvec3 normal = glm::cross(edge, caster - corner);
        const double length = glm::length(normal);
        if (length > 0.0 && separates(shapes, normal / length)) return true;
      }
    }
  }
  return false;
}

// A witness that settles most pairs that do meet: the ray from the light's centre through the caster's.
bool centralRayMeets(const glm::dvec3& lightCenter, const glm::dvec3& casterCenter,
                     const scene::Bounds& receiver) {
  double low = 1.0,
         high = std::numeric_limits<double>::infinity();  // multiples of the step from light to caster
  for (int axis = 0; axis < 3; ++axis) {
    const double step = casterCenter[axis] - lightCenter[axis];
    const double toLow = receiver.low[axis] - lightCenter[axis],
                 toHigh = receiver.high[axis] - lightCenter[axis];
    if (step == 0.0) {
      if (toLow > 0.0 || toHigh < 0.0) return false;
      continue;
    }
    low = std::max(low, std::min(toLow / step, toHigh / step));
    high = std::min(high, std::max(toLow / step, toHigh / step));
  }
  return low <= high;
}

}  // namespace

bool shadowRegionMeets(const scene::AreaLight& light, const scene::Bounds& casterWorld,
                       const scene::Bounds& receiverWorld) {
  return shadowRegionMeets(light, lightSpace(light), casterWorld, receiverWorld);
}

bool shadowRegionMeets(const scene::AreaLight& light, const LightSpace& space,
                       const scene::Bounds& casterWorld, const scene::Bounds& receiverWorld) {
  if (casterWorld.empty() || receiverWorld.empty()) return false;
  const scene::Bounds caster = space.boundsLight(casterWorld), receiver = space.boundsLight(receiverWorld);
  // Rounding in light space is relative to the world coordinates that were subtracted.
  const double scale =
      std::max({largestCoordinate(caster), largestCoordinate(receiver), space.halfSize.x, space.halfSize.y,
                1e-6 * largestCoordinate(casterWorld), 1e-6 * largestCoordinate(receiverWorld)});
  const double slack = kSlack * scale;
  if (caster.high.z <= -slack || receiver.high.z <= -slack) return false;  // behind the light's plane
  if (receiver.high.z < caster.low.z - slack) return false;  // nearer to the light than the caster
  const glm::dvec3 casterCenter = casterWorld.center();
  if (space.lightFromWorld(casterCenter).z > 0.0 &&
      centralRayMeets(light.centerWorld, casterCenter, receiverWorld)) {
    return true;
  }
  const double casterLow = std::max(0.0, caster.low.z - slack);
  const double casterHigh = std::min(caster.high.z, receiver.high.z) + slack;
  StretchRange stretch;
  stretch.low = std::max(1.0, (receiver.low.z - slack) / casterHigh);
  stretch.high = casterLow > 0.0 ? std::max(stretch.low, (receiver.high.z + slack) / casterLow)
                                 : std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    const double stretchSlack =
        slack * (std::isfinite(stretch.high) ? 1.0 + stretch.high : 1.0 + stretch.low);
    if (!axisMeets(space.halfSize[axis], caster.low[axis], caster.high[axis], receiver.low[axis],
                   receiver.high[axis], stretch, stretchSlack)) {
      return false;
    }
  }
  Shapes shapes{.light = lightCornersRelative(light), .longestStretch = stretch.high - 1.0, .slack = slack};
  const auto casterCorners = casterWorld.corners(), receiverCorners = receiverWorld.corners();
  for (std::size_t i = 0; i < 8; ++i) {
    shapes.caster[i] = casterCorners[i] - light.centerWorld;
    shapes.receiver[i] = receiverCorners[i] - light.centerWorld;
  }
  return !tangentPlaneSeparates(shapes, light);
}

bool visibleFrom(const scene::Camera& camera, double aspectWidthOverHeight,
                 const scene::Bounds& boundsWorld) {
  return visibleIn(scene::clipFromView(camera, aspectWidthOverHeight) * scene::viewFromWorld(camera),
                   boundsWorld);
}

bool visibleIn(const glm::dmat4& clipFromWorld, const scene::Bounds& boundsWorld) {
  if (boundsWorld.empty()) return false;
  std::array<glm::dvec4, 8> clip;
  double scale = 0.0;
  const auto corners = boundsWorld.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    clip[i] = clipFromWorld * glm::dvec4(corners[i], 1.0);
    for (int axis = 0; axis < 4; ++axis) scale = std::max(scale, std::abs(clip[i][axis]));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      if (std::all_of(clip.begin(), clip.end(),
                      [&](const glm::dvec4& c) { return side * c[axis] > c.w + kSlack * scale; })) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace halfshadow::planner
