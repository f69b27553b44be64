// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/occlusion_textures/slice_space.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace halfshadow::techniques {
namespace {
// The pyramid of the paper degenerates to a prism when the light is larger than the casters: beyond this
// multiple of their distance nothing changes any more.
constexpr double kLargestOffset = 16.0;
// Casters farther off-axis are cut, as in planner::LightFitOptions.
constexpr double kMaxTangent = 8.0;
// Longest side of the light's frustum over its shortest, in texels, that is evened out by stretching the map.
constexpr double kLargestStretch = 4.0;
// Depths are drawn as far as this many times the farthest receiver, so that rounding and the fit's steps cut
// none.
constexpr double kDepthReserve = 4.0;
// Share of the casters' depth range left free at both ends, so that no caster lies on the border itself.
constexpr double kDepthMargin = 1.0 / 256;
// Of the casters' size, for those that are flat; of distances.
constexpr double kLeastThickness = 1e-4, kRounding = 1e-13;

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) { low = std::min(low, value), high = std::max(high, value); }
  double extent() const { return high - low; }
  /// Grown about its middle.
  void grow(double extentWanted) {
    const double middle = 0.5 * (low + high);
    low = middle - 0.5 * extentWanted;
    high = middle + 0.5 * extentWanted;
  }
};

/// Distance behind the light at which the pyramid through the light's outline just holds all points.
/// Based on: Eisemann, Décoret 2006, section 3.4 (centre of projection with offset).
double pyramidOffset(const planner::LightFit& fit, const std::vector<glm::dvec3>& points) {
  double offset = kLargestOffset * fit.farDistance;
  for (const glm::dvec3& p : points) {
    for (int axis = 0; axis < 2; ++axis) {
      const double beyond = std::abs(p[axis]) - fit.halfSize[axis];
      if (beyond > 0.0) offset = std::min(offset, fit.halfSize[axis] * p.z / beyond);
    }
  }
  return offset;
}

/// Side of the largest tiles of which `count` stand side by side: a multiple of 8, for the levels of filters.
int tileSide(int atlasSize, int count) {
  return count == 1 ? atlasSize : atlasSize / count / 8 * 8;
}

/// Maps are as wide and as high as their content asks for: a row of posts in tiles side by side would have a
/// quarter of the texels that it has in tiles one above the other.
void setTiles(const SliceOptions& options, const glm::dvec2& extent, SliceSpace& space) {
  constexpr int kLeastSide = 48;
  constexpr double kClearlyFiner = 0.9;  // than square tiles
  space.grid = options.grid;
  space.atlasSize = options.mapSize;
  const int count = options.grid.count();
  const auto roundUp = [&](int n) {
    return options.powersOfTwo ? static_cast<int>(std::bit_ceil(static_cast<unsigned>(n))) : n;
  };
  const auto coarseness = [&](const glm::ivec2& size) {
    return std::max(extent.x / size.x, extent.y / size.y);
  };
  space.tiles = glm::ivec2(roundUp(options.grid.tilesPerSide()));
  space.mapSize = glm::ivec2(tileSide(options.mapSize, space.tiles.x));
  double least = kClearlyFiner * coarseness(space.mapSize);
  for (int i = 1; i <= count; ++i) {
    const int columns = roundUp(i), rows = roundUp((count + columns - 1) / columns);
    const glm::ivec2 size(tileSide(options.mapSize, columns), tileSide(options.mapSize, rows));
    if (std::min(size.x, size.y) < kLeastSide || coarseness(size) >= least) continue;
    least = coarseness(size);
    space.tiles = {columns, rows};
    space.mapSize = size;
  }
}

/// Of all views, in the light's plane.
std::vector<glm::dvec2> viewCenters(const planner::SubLights* split) {
  if (split == nullptr) return {glm::dvec2(0.0)};
  std::vector<glm::dvec2> centers;
  for (int j = 0; j < split->grid.alongV; ++j) {
    for (int i = 0; i < split->grid.alongU; ++i) {
      centers.push_back((i - 0.5 * (split->grid.alongU - 1)) * split->stepU +
                        (j - 0.5 * (split->grid.alongV - 1)) * split->stepV);
    }
  }
  return centers;
}

/// Of the caster in light space, none before the near distance. Points that are moved there no longer hold
/// the others: then all vertices are taken.
void appendPoints(const planner::LightFit& fit, const planner::CasterShape& caster,
                  std::vector<glm::dvec3>& points) {
  const auto add = [&](const glm::dmat4& lightFromPoint, const glm::dvec3& point) {
    glm::dvec3 p = glm::dvec3(lightFromPoint * glm::dvec4(point, 1.0));
    const bool moved = p.z < fit.nearDistance;
    p.z = std::max(p.z, fit.nearDistance);
    points.push_back(p);
    return moved;
  };
  bool anyMoved = false;
  for (const glm::dvec3& world : caster.pointsWorld) anyMoved = add(fit.lightFromWorld, world) || anyMoved;
  if (!anyMoved || caster.mesh == nullptr) return;
  const glm::dmat4 lightFromObject = fit.lightFromWorld * *caster.worldFromObject;
  for (const std::uint32_t vertex : caster.mesh->indices)
    add(lightFromObject, glm::dvec3(caster.mesh->positions[vertex]));
}

/// Which slices casters touch, by their triangles: one that the caster's box reaches may lie between its
/// parts.
class OccupiedSlices {
 public:
  OccupiedSlices(const planner::LightFit& fit, const std::vector<double>& borders)
      : fit_(fit), borders_(borders), occupied_(borders.size() - 1, false) {}

  /// `sliceOf`: place in slice units at a distance from the light's plane.
  void add(const planner::CasterShape& caster, auto sliceOf) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const glm::dvec3& world : caster.pointsWorld) {
      const double at = sliceOf(distanceOf(glm::dvec4(world, 1.0), fit_.lightFromWorld));
      low = std::min(low, at), high = std::max(high, at);
    }
    if (caster.mesh == nullptr) return mark(low, high);
    const glm::dmat4 lightFromObject = fit_.lightFromWorld * *caster.worldFromObject;
    const scene::TriangleMesh& mesh = *caster.mesh;
    for (std::size_t i = 0; i + 2 < mesh.indices.size() && !allMarked(low, high); i += 3) {
      double from = std::numeric_limits<double>::infinity(), to = -from;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 position(mesh.positions[mesh.indices[i + k]]);
        const double at = sliceOf(distanceOf(glm::dvec4(position, 1.0), lightFromObject));
        from = std::min(from, at), to = std::max(to, at);
      }
      mark(from, to);
    }
  }

  void sort(SliceSuccessors successors, SliceSpace& space) const {
    const bool closing = successors == SliceSuccessors::kept;
    for (std::size_t k = 0; k < occupied_.size(); ++k) {
      const bool follows = closing && k > 0 && occupied_[k - 1];
      if (occupied_[k] || follows) {
        space.slices.push_back(
            {.low = borders_[k], .high = borders_[k + 1], .casterLow = borders_[follows ? k - 1 : k]});
      } else {
        space.emptySlices.push_back(static_cast<int>(k));
      }
    }
  }

 private:
  double distanceOf(const glm::dvec4& point, const glm::dmat4& lightFromPoint) const {
    return std::max(glm::dvec3(lightFromPoint * point).z, fit_.nearDistance);
  }
  bool touches(std::size_t k, double low, double high) const {
    return low <= borders_[k + 1] && high >= borders_[k];
  }
  void mark(double low, double high) {
    for (std::size_t k = 0; k < occupied_.size(); ++k) {
      if (touches(k, low, high)) occupied_[k] = true;
    }
  }
  bool allMarked(double low, double high) const {
    for (std::size_t k = 0; k < occupied_.size(); ++k) {
      if (touches(k, low, high) && !occupied_[k]) return false;
    }
    return true;
  }

  const planner::LightFit& fit_;
  const std::vector<double>& borders_;
  std::vector<bool> occupied_;
};
}  // namespace

Result<SliceSpace> makeSliceSpace(const planner::LightFit& fit, std::span<const planner::CasterShape> casters,
                                  const SliceOptions& options, const planner::SubLights* split) {
  if (options.slices < 4 || options.slices > 16) {
    return Error{ErrorCode::invalidArgument, "occlusion-textures.slices=" + std::to_string(options.slices) +
                                                 " is outside 4-16; choose 4, 8, 12 or 16"};
  }
  if (options.mapSize < kLeastMapSize || options.mapSize > kMostMapSize) {
    return Error{ErrorCode::invalidArgument,
                 "occlusion-textures.map_size=" + std::to_string(options.mapSize) + " is outside 64-1024"};
  }
  const bool perspective = options.projection == SliceProjection::perspective;
  std::vector<glm::dvec3> points;
  Interval depth, lateral[2];
  for (const planner::CasterShape& caster : casters) appendPoints(fit, caster, points);
  for (const glm::dvec3& p : points) {
    depth.include(p.z);
    for (int axis = 0; axis < 2; ++axis) lateral[axis].include(p[axis]);
  }
  if (fit.empty || points.empty() || !(depth.high > 0.0)) {
    return Error{ErrorCode::invalidArgument,
                 "no caster lies in front of the light, so there is nothing to slice"};
  }
  SliceSpace space;
  const double offset =
      perspective && options.center == SliceCenter::behind ? pyramidOffset(fit, points) : 0.0;
  space.offsetDistance = offset;

  // Flat casters parallel to the light still get slices of some thickness: a share of their own size, and no
  // less than double precision holds at their distance.
  const double size = std::max({depth.extent(), lateral[0].extent(), lateral[1].extent()});
  const double margin =
      std::max({depth.extent() * kDepthMargin, size * kLeastThickness, depth.high * kRounding});
  const double near = std::max(depth.low - margin, 0.5 * depth.low), far = depth.high + margin;
  // Reciprocal depth at both ends as seen from the centre of projection.
  const double qNear = 1.0 / (near + offset), qFar = 1.0 / (far + offset);
  const auto sliceOf = [&](double z) {
    return perspective ? (qNear - 1.0 / (z + offset)) / (qNear - qFar) : (z - near) / (far - near);
  };

  // The map's extent: tangents seen from the centre of projection, or lengths.
  // Views agree in the middle of the slices; elsewhere they lie apart by this times the difference of 1/z.
  const std::vector<glm::dvec2> centers = viewCenters(split);
  glm::dvec2 spread(0.0);
  for (const glm::dvec2& c : centers) spread = glm::max(spread, glm::abs(c));
  space.alignedSlice = 0.5;
  const double qAligned = 0.5 * (qNear + qFar);
  Interval sides[2];
  for (int axis = 0; axis < 2; ++axis) {
    for (const glm::dvec3& p : points) {
      const double apart = spread[axis] * std::abs(1.0 / p.z - qAligned);
      const double place = perspective ? p[axis] / (p.z + offset) : p[axis];
      sides[axis].include(place - apart);
      sides[axis].include(place + apart);
    }
    const double limit = perspective ? kMaxTangent : std::numeric_limits<double>::infinity();
    sides[axis] = {std::max(sides[axis].low, -limit), std::min(sides[axis].high, limit)};
    if (!(sides[axis].high >= sides[axis].low)) {
      return Error{ErrorCode::invalidArgument,
                   "all casters lie more than 82 degrees off the light's axis; turn the light towards them"};
    }
    // Casters seen edge-on, or as a point.
    const double least = std::max(size * kLeastThickness, depth.high * kRounding) / (perspective ? far : 1.0);
    if (sides[axis].extent() < least) sides[axis].grow(least);
  }
  // Filters are square: stretch the smaller side until the light's frustum is square in texels.
  const glm::dvec2 light = split != nullptr ? split->halfSize : fit.halfSize;
  double ratio = 1.0;
  if (std::max(light.x, light.y) > 0.0) {
    ratio = light.x > 0.0 ? std::clamp(light.y / light.x, 1.0 / kLargestStretch, kLargestStretch)
                          : kLargestStretch;
  }
  setTiles(options, {sides[0].extent(), sides[1].extent() / ratio}, space);
  for (int axis = 0; axis < 2; ++axis) {
    const double usable = space.mapSize[axis] - 2.0 * options.borderTexels;
    sides[axis].grow(sides[axis].extent() * space.mapSize[axis] / usable);
  }
  if (std::max(light.x, light.y) > 0.0) {
    ratio *= static_cast<double>(space.mapSize.y) / space.mapSize.x;
    const double wanted = sides[0].extent() * ratio;
    if (wanted > sides[1].extent()) {
      sides[1].grow(wanted);
    } else {
      sides[0].grow(sides[1].extent() / ratio);
    }
  }
  const glm::dvec2 low{sides[0].low, sides[1].low}, extent{sides[0].extent(), sides[1].extent()};
  space.center = -low / extent;
  const glm::dvec2 lightTexels = light / extent * glm::dvec2(space.mapSize);
  const double longest = std::max(lightTexels.x, lightTexels.y);
  if (longest > 0.0) space.shape = lightTexels / longest;

  const double depthSlices =
      kDepthReserve *
      std::max(1.0, options.receiverFarDistance > far ? sliceOf(options.receiverFarDistance) : 0.0);

  // Rows of (x, y, n, z), all divided by the farthest distance.
  const double unit = 1.0 / far;
  glm::dmat4 mapFromLight(0.0);
  mapFromLight[0][0] = unit / extent.x;
  mapFromLight[1][1] = unit / extent.y;
  mapFromLight[2][3] = unit;
  const double side = 2.0 * longest;
  glm::dmat4 clipFromLight(0.0);
  if (perspective) {
    // s = (qNear (z + offset) - 1) / ((qNear - qFar) (z + offset))
    const double scale = 1.0 / (qNear - qFar);
    mapFromLight[2][2] = scale * qNear * unit;
    mapFromLight[3][2] = scale * (qNear * offset - 1.0) * unit;
    space.divisorScale = 1.0;
    space.divisorConstant = offset * unit;
    // On plane s: q = qNear + s (qFar - qNear), z = 1/q - offset, ratio = z q = 1 - offset q.
    space.ratio0 = 1.0 - offset * qNear;
    space.ratio1 = -offset * (qFar - qNear);
    // q(s) - q(own) ratio(s) / (z q(own)), in which 1 - offset q = z q.
    space.sideScale = side * (qNear - qFar);
    space.widestTexels = side * qNear;
    // Not beyond what is infinitely far away, where q = 0.
    space.depthSlices = std::min(depthSlices, scale * qNear);
    const double depthScale = 2.0 * scale / space.depthSlices;
    clipFromLight[0][0] = 2.0 / extent.x;
    clipFromLight[1][1] = 2.0 / extent.y;
    clipFromLight[2] = glm::dvec4(2.0 * space.center - 1.0, depthScale * qNear - 1.0, 1.0);
    clipFromLight[3] =
        glm::dvec4((2.0 * space.center - 1.0) * offset, depthScale * (qNear * offset - 1.0) - offset, offset);
    // Homogeneous coordinates near 1: they cross the rasteriser as mediump varyings.
    clipFromLight *= unit;
    if (split != nullptr) {
      space.stepU = split->stepU / (scale * extent);
      space.stepV = split->stepV / (scale * extent);
    }
  } else {
    const double scale = 1.0 / (far - near);
    mapFromLight[2][2] = scale * unit;
    mapFromLight[3][2] = -near * scale * unit;
    space.divisorScale = 0.0;
    space.divisorConstant = unit;
    space.ratio0 = near;
    space.ratio1 = far - near;
    space.sideScale = side * (far - near);
    space.widestTexels = side;
    space.depthSlices = depthSlices;
    const double depthScale = 2.0 * scale / space.depthSlices;
    clipFromLight[0][0] = 2.0 / extent.x;
    clipFromLight[1][1] = 2.0 / extent.y;
    clipFromLight[2][2] = depthScale;
    clipFromLight[3] = glm::dvec4(2.0 * space.center - 1.0, -near * depthScale - 1.0, 1.0);
  }
  space.mapFromWorld = mapFromLight * fit.lightFromWorld;
  const glm::dmat4 worldFromLight = glm::inverse(fit.lightFromWorld);
  for (const glm::dvec2& c : centers) {
    // A view from c: x - c + c z qAligned instead of x.
    glm::dmat4 clip = clipFromLight;
    for (int axis = 0; axis < 2; ++axis) {
      clip[2][axis] += clip[axis][axis] * c[axis] * qAligned;
      clip[3][axis] -= clip[axis][axis] * c[axis];
    }
    space.views.push_back(
        {.clipFromWorld = clip * fit.lightFromWorld,
         .originWorld = glm::dvec3(worldFromLight * glm::dvec4(c, -space.offsetDistance, 1.0))});
  }

  std::vector<double> borders;
  for (int k = 0; k <= options.slices; ++k) {
    const double share = static_cast<double>(k) / options.slices;
    borders.push_back(sliceOf(near + share * (far - near)));
  }
  OccupiedSlices occupied(fit, borders);
  for (const planner::CasterShape& caster : casters) occupied.add(caster, sliceOf);
  occupied.sort(options.successors, space);
  return space;
}

}  // namespace halfshadow::techniques
