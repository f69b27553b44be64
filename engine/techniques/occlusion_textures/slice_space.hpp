// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The space in which casters are cut into slices parallel to the light: projection, slice borders, and the
/// part of a slice that a receiver's light frustum covers. Pure data, double precision.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/rect.hpp"
#include "planner/light_fit.hpp"
#include "planner/sub_lights.hpp"

namespace halfshadow::techniques {

enum class SliceProjection {
  perspective,  ///< from a point on the light's axis
  orthographic  ///< along the light's axis
};
/// Centre of a perspective projection.
enum class SliceCenter {
  light,  ///< the light's centre
  behind  ///< behind it, where the pyramid through the light's outline just holds the casters
};
enum class SliceSuccessors { dropped, kept };
inline constexpr int kLeastMapSize = 64, kMostMapSize = 1024;

struct SliceOptions {
  int slices = 4;
  int mapSize = 256;
  int borderTexels = 3;  ///< kept empty, so that clamped fetches outside read "nothing there"
  SliceProjection projection = SliceProjection::perspective;
  SliceCenter center = SliceCenter::light;
  /// Also keep the slice behind an occupied one, which casters are projected on to close leaks.
  SliceSuccessors successors = SliceSuccessors::dropped;
  double receiverFarDistance = 0.0;  ///< of the farthest receiver below the map, 0 = none
  /// Seen from each of these parts of the light; with `mapSize` texels a side for all.
  planner::SubLightGrid grid;
  bool powersOfTwo = false;  ///< sides of tiles and of their atlas, which hardware mipmaps ask for
  bool operator==(const SliceOptions&) const = default;
};

/// A slice; borders in slice units.
struct Slice {
  double low = 0.0, high = 1.0;
  double casterLow = 0.0;  ///< casters from here on are projected on it
};

/// One of the maps, from one point of the light.
struct SliceView {
  glm::dmat4 clipFromWorld{1.0};  ///< of the slicing passes; depth 0 … 1 is s from 0 to depthSlices
  glm::dvec3 originWorld{0.0};    ///< centre of projection (orthographic: the light's centre)
};

/// Slice units s run from 0 (just nearer than the nearest caster) to 1 (just beyond the farthest), affine in
/// 1/distance from the centre of projection (perspective) or in distance (orthographic): place and size of
/// the light's frustum on the plane s, as seen in the map, are then affine in s too. Slices have equal
/// thickness in world units: measured against equal steps of s, objects come out better (penumbra RMSE on
/// casters .121 against .181 at four slices) and the ground the same.
/// Sub-lights share slices, the window and all that follows but their views: what the light's centre sees at
/// d in the map, at own slice units, a sub-light (i, j) steps beside it sees at d + (i stepU + j stepV) (own
/// - alignedSlice).
struct SliceSpace {
  /// world -> (x, y, n, z): x/z and y/z times ratio(s), plus center, is the place in the map [0, 1]² where
  /// the line to the light's centre meets plane s; n / (z·divisorScale + divisorConstant) is the position's
  /// own s. All four are scaled so that z = 1 at the farthest caster.
  glm::dmat4 mapFromWorld{1.0};
  double depthSlices = 1.0;  ///< of the views' depth range: far enough for receivers behind all casters
  glm::dvec2 center{0.5};
  double divisorScale = 1.0, divisorConstant = 0.0;
  double ratio0 = 1.0, ratio1 = 0.0;  ///< ratio(s) = ratio0 + s ratio1
  /// Longer side of the light's (or a sub-light's) frustum on plane s, texels, of a receiver at `own`:
  /// sideScale (own - s) (divisorScale + divisorConstant / z). A difference of slice units, not of distances:
  /// seen from a sun, all distances are the same number.
  double sideScale = 0.0;
  glm::dvec2 shape{1.0};         ///< its two sides, the longer one 1
  double offsetDistance = 0.0;   ///< of the centre of projection behind the light, world units
  double widestTexels = 0.0;     ///< largest side on any slice, for receivers however far
  int atlasSize = 256;           ///< texels a side of the atlas of all views' maps
  glm::ivec2 mapSize{256};       ///< texels of one of them
  glm::ivec2 tiles{1};           ///< columns and rows
  std::vector<SliceView> views;  ///< along halfU first, then along halfV
  planner::SubLightGrid grid;
  glm::dvec2 stepU{0.0}, stepV{0.0};  ///< between neighbours, of the map's sides
  double alignedSlice = 1.0;          ///< plane on which all views' maps show the same
  /// A view's part of an atlas `scale` times as fine.
  Rect tile(std::size_t view, int scale) const {
    const int index = static_cast<int>(view);
    const glm::ivec2 size = scale * mapSize;
    return {index % tiles.x * size.x, index / tiles.x * size.y, size.x, size.y};
  }
  std::vector<Slice> slices;     ///< those that hold casters, nearest first
  std::vector<int> emptySlices;  ///< positions of the others, from 0
};

/// `fit` is the frame's fit (its near distance cuts casters at the light's plane); `split` has options.grid,
/// or is null where that is whole. Errors: invalidArgument (slices outside 4-16, map size outside 64-1024, no
/// caster in front of the light).
Result<SliceSpace> makeSliceSpace(const planner::LightFit& fit, std::span<const planner::CasterShape> casters,
                                  const SliceOptions& options, const planner::SubLights* split = nullptr);

}  // namespace halfshadow::techniques
