// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/occlusion_textures/slice_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace halfshadow::techniques {
namespace {

/// Triangles as consecutive triples: tetrahedron-like fans between random corners of a box.
std::vector<glm::dvec3> casterPoints(const glm::dvec3& low, const glm::dvec3& high, int triangles,
                                     unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 3 * triangles; ++i) {
    points.push_back(low + (high - low) * glm::dvec3(share(random), share(random), share(random)));
  }
  return points;
}

scene::AreaLight lightAt(const glm::dvec3& center, double sizeU, double sizeV) {
  auto light = scene::areaLightAimed(center, {0, 0, 0}, sizeU, sizeV, {0, 0, 1});
  EXPECT_TRUE(light.ok());
  return *light;
}

Result<SliceSpace> spaceOf(const planner::LightFit& fit, const std::vector<glm::dvec3>& points,
                           const SliceOptions& options, const planner::SubLights* split = nullptr) {
  const planner::CasterShape caster{.pointsWorld = points};
  return makeSliceSpace(fit, {&caster, 1}, options, split);
}

struct Case {
  SliceProjection projection;
  SliceCenter center;
};
const Case kCases[] = {{SliceProjection::perspective, SliceCenter::light},
                       {SliceProjection::perspective, SliceCenter::behind},
                       {SliceProjection::orthographic, SliceCenter::light}};

/// Place in the map and in slice units of a point of the scene, as the slicing pass draws it.
glm::dvec3 drawnAt(const SliceSpace& space, const glm::dvec3& world) {
  const glm::dvec4 clip = space.views.front().clipFromWorld * glm::dvec4(world, 1.0);
  return (glm::dvec3(clip) / clip.w * 0.5 + 0.5) * glm::dvec3(1.0, 1.0, space.depthSlices);
}

// What the receiver shader computes must be where the light's outline, seen from the receiver, cuts the
// slice.
TEST(SliceSpace, FrustumSectionsOfReceiversAreThoseOfTheGeometry) {
  const scene::AreaLight light = lightAt({3, 12, 2}, 2.0, 1.2);
  const auto points = casterPoints({-1.5, 0.2, -1.2}, {1.4, 3.1, 1.0}, 40, 1);
  const planner::LightFit fit = planner::fitLight(light, points, {});
  std::mt19937 random(2);
  std::uniform_real_distribution<double> lateral(-2.0, 2.0);
  for (const Case& tested : kCases) {
    const auto space = spaceOf(fit, points, {.projection = tested.projection, .center = tested.center});
    ASSERT_TRUE(space.ok());
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 receiver(lateral(random), -1.0, lateral(random));
      const glm::dvec4 map = space->mapFromWorld * glm::dvec4(receiver, 1.0);
      // A point of the plane: on the line from the receiver to the light's centre.
      const double share = 0.7 + 0.01 * (i % 20);
      const glm::dvec3 onPlane = glm::mix(light.centerWorld, receiver, share);
      const glm::dvec3 expected = drawnAt(*space, onPlane);
      const double s = expected.z;
      const double ratio = space->ratio0 + s * space->ratio1;
      const glm::dvec2 middle = space->center + glm::dvec2(map.x, map.y) / map.w * ratio;
      // 1e-9: double precision with room for the cancellation in 1/distance.
      EXPECT_NEAR(middle.x, expected.x, 1e-9);
      EXPECT_NEAR(middle.y, expected.y, 1e-9);
      // The receiver's own slice coordinate.
      EXPECT_NEAR(map.z / (space->divisorScale * map.w + space->divisorConstant), drawnAt(*space, receiver).z,
                  1e-9);
      // The frustum's sides: between the lines to the middles of the light's edges.
      const double divisor = space->divisorScale * map.w + space->divisorConstant;
      const double side = space->sideScale * (map.z / divisor - s) * divisor / map.w;
      const auto sideAlong = [&](const glm::dvec3& half, int axis) {
        const glm::dvec3 a = drawnAt(*space, glm::mix(light.centerWorld + half, receiver, share));
        const glm::dvec3 b = drawnAt(*space, glm::mix(light.centerWorld - half, receiver, share));
        return std::abs(a[axis] - b[axis]) * space->mapSize.x;
      };
      EXPECT_NEAR(side * space->shape.x, sideAlong(light.halfU, 0), 1e-6);
      EXPECT_NEAR(side * space->shape.y, sideAlong(light.halfV, 1), 1e-6);
      EXPECT_LE(side, space->widestTexels + 1e-9);
    }
  }
}

TEST(SliceSpace, EveryCasterLiesInsideTheMapAndInASlice) {
  const auto points = casterPoints({-1.5, 0.2, -1.2}, {1.4, 3.1, 1.0}, 40, 3);
  const planner::LightFit fit = planner::fitLight(lightAt({3, 12, 2}, 2.0, 2.0), points, {});
  for (const Case& tested : kCases) {
    for (const int slices : {4, 7, 16}) {
      const auto space =
          spaceOf(fit, points, {.slices = slices, .projection = tested.projection, .center = tested.center});
      ASSERT_TRUE(space.ok());
      // Three texels of border; half a texel of the triangles' own extent may reach into it.
      const double border = 2.5 / space->mapSize.x;
      for (const glm::dvec3& point : points) {
        const glm::dvec3 at = drawnAt(*space, point);
        EXPECT_GT(at.x, border);
        EXPECT_LT(at.x, 1.0 - border);
        EXPECT_GT(at.y, border);
        EXPECT_LT(at.y, 1.0 - border);
        EXPECT_TRUE(std::ranges::any_of(
            space->slices, [&](const Slice& slice) { return slice.low <= at.z && at.z < slice.high; }));
      }
    }
  }
}

// The paper's centre of projection: the pyramid through the light's outline just holds the casters.
TEST(SliceSpace, PyramidThroughTheLightsOutlineJustHoldsTheCasters) {
  const auto points = casterPoints({-1.5, 0.2, -1.2}, {1.4, 3.1, 1.0}, 40, 4);
  const planner::LightFit fit = planner::fitLight(lightAt({0, 12, 0}, 1.0, 1.0), points, {});
  const auto space = spaceOf(fit, points, {.center = SliceCenter::behind});
  ASSERT_TRUE(space.ok());
  const double tangent = fit.halfSize.x / space->offsetDistance;
  double widest = 0.0;
  for (const glm::dvec3& world : points) {
    const glm::dvec3 p = glm::dvec3(fit.lightFromWorld * glm::dvec4(world, 1.0));
    widest = std::max({widest, std::abs(p.x) / (p.z + space->offsetDistance),
                       std::abs(p.y) / (p.z + space->offsetDistance)});
  }
  EXPECT_NEAR(widest, tangent, 1e-9 * tangent);
}

TEST(SliceSpace, SlicesWithoutCastersAreDroppedAndNamed) {
  auto points = casterPoints({-1, 5, -1}, {1, 5.3, 1}, 20, 5);
  const auto low = casterPoints({-1, 0, -1}, {1, 0.3, 1}, 20, 6);
  points.insert(points.end(), low.begin(), low.end());
  scene::TriangleMesh mesh;  // of two parts, with nothing between them
  for (const glm::dvec3& point : points) {
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.emplace_back(point);
  }
  const glm::dmat4 worldFromObject(1.0);
  const planner::CasterShape caster{
      .pointsWorld = points, .mesh = &mesh, .worldFromObject = &worldFromObject};
  const planner::LightFit fit = planner::fitLight(lightAt({0, 12, 0.01}, 1.0, 1.0), points, {});
  const auto space = makeSliceSpace(fit, {&caster, 1}, {.slices = 8});
  ASSERT_TRUE(space.ok());
  // Casters fill 0.3 of 5.3 units at each end; a slice is 0.66 thick.
  EXPECT_EQ(space->slices.size(), 2u);
  EXPECT_EQ(space->emptySlices, (std::vector<int>{1, 2, 3, 4, 5, 6}));
  // Closing leaks projects each occupied slice on the next, which is then needed.
  const auto closing = makeSliceSpace(fit, {&caster, 1}, {.slices = 8, .successors = SliceSuccessors::kept});
  ASSERT_TRUE(closing.ok());
  ASSERT_EQ(closing->slices.size(), 3u);
  EXPECT_EQ(closing->slices[1].casterLow, closing->slices[0].low);
  EXPECT_EQ(closing->slices[1].low, closing->slices[0].high);
}

TEST(SliceSpace, RefusesWhatItCannotSliceAndSaysWhy) {
  const auto points = casterPoints({-1, 0, -1}, {1, 1, 1}, 4, 7);
  const planner::LightFit fit = planner::fitLight(lightAt({0, 12, 0.01}, 1.0, 1.0), points, {});
  for (const SliceOptions& options : {SliceOptions{.slices = 3}, SliceOptions{.slices = 17},
                                      SliceOptions{.mapSize = 32}, SliceOptions{.mapSize = 2048}}) {
    const auto space = spaceOf(fit, points, options);
    ASSERT_FALSE(space.ok());
    EXPECT_EQ(space.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(space.error().message.find("is outside"), std::string::npos);
  }
  const auto above = casterPoints({-1, 20, -1}, {1, 21, 1}, 4, 8);
  const auto behind = spaceOf(planner::fitLight(lightAt({0, 12, 0.01}, 1.0, 1.0), above, {}), above, {});
  ASSERT_FALSE(behind.ok());
  EXPECT_NE(behind.error().message.find("no caster"), std::string::npos);
}

TEST(SliceSpace, DegenerateLightsAndCastersGiveFiniteSpaces) {
  const auto block = casterPoints({-1, 0, -1}, {1, 1, 1}, 20, 9);
  const auto flat = casterPoints({-1, 1, -1}, {1, 1, 1}, 20, 10);
  const auto around = casterPoints({-1, 11, -1}, {1, 13, 1}, 20, 11);  // crosses the light's plane
  const std::vector<glm::dvec3> point(3, glm::dvec3(0.0));
  struct Size {
    double u, v;
  };
  for (const Size size : {Size{0, 0}, Size{1, 1e-6}, Size{1e-6, 1}, Size{20, 0.1}, Size{500, 500}}) {
    for (const auto& points : {block, flat, around, point}) {
      for (const Case& tested : kCases) {
        const planner::LightFit fit = planner::fitLight(lightAt({0, 12, 0.01}, size.u, size.v), points, {});
        const auto space = spaceOf(fit, points, {.projection = tested.projection, .center = tested.center});
        ASSERT_TRUE(space.ok());
        for (int column = 0; column < 4; ++column) {
          EXPECT_FALSE(glm::any(glm::isnan(space->mapFromWorld[column])) ||
                       glm::any(glm::isinf(space->mapFromWorld[column])));
          EXPECT_FALSE(glm::any(glm::isnan(space->views.front().clipFromWorld[column])) ||
                       glm::any(glm::isinf(space->views.front().clipFromWorld[column])));
        }
        EXPECT_TRUE(std::isfinite(space->widestTexels));
        EXPECT_GE(space->slices.size(), 1u);
        for (const Slice& slice : space->slices) EXPECT_GT(slice.high, slice.low);
        EXPECT_NEAR(std::max(space->shape.x, space->shape.y), 1.0, 1e-12);
      }
    }
  }
}

// A sub-light's map holds all casters, and a place there is the centre's plus a step for the point's own
// slice.
TEST(SliceSpace, SubLightsSeeAStepBesideTheCentre) {
  const scene::AreaLight light = lightAt({1, 12, 2}, 3.0, 2.0);
  for (const glm::dvec3& half : {glm::dvec3(3, 1, 3), glm::dvec3(6, 1, 0.3), glm::dvec3(0.3, 1, 6)}) {
    const std::vector<glm::dvec3> points = casterPoints(-half, half, 40, 3);
    const planner::LightFit fit = planner::fitLight(light, points, {});
    for (const planner::SubLightGrid grid : {planner::SubLightGrid{2, 2}, planner::SubLightGrid{3, 2}}) {
      for (const bool powersOfTwo : {false, true}) {
        const planner::SubLights split =
            planner::fitSubLights(light, points, grid, planner::subLightMapSize(grid, 1024));
        const auto space = spaceOf(fit, points, {.grid = grid, .powersOfTwo = powersOfTwo}, &split);
        ASSERT_TRUE(space.ok());
        ASSERT_EQ(space->views.size(), 1u * grid.count());
        EXPECT_LE(space->tiles.x * space->mapSize.x, space->atlasSize);
        EXPECT_LE(space->tiles.y * space->mapSize.y, space->atlasSize);
        for (std::size_t k = 0; k < space->views.size(); ++k) {
          const Rect tile = space->tile(k, 2);
          EXPECT_LE(std::max(tile.x + tile.width, tile.y + tile.height), 2 * space->atlasSize);
          const int i = static_cast<int>(k) % grid.alongU, j = static_cast<int>(k) / grid.alongU;
          for (const glm::dvec3& p : points) {
            const glm::dvec4 map = space->mapFromWorld * glm::dvec4(p, 1.0);
            const double own = map.z / map.w;
            const glm::dvec2 steps =
                (i - 0.5 * (grid.alongU - 1)) * space->stepU + (j - 0.5 * (grid.alongV - 1)) * space->stepV;
            const glm::dvec2 expected =
                space->center + glm::dvec2(map) / map.w + steps * (own - space->alignedSlice);
            const glm::dvec4 clip = space->views[k].clipFromWorld * glm::dvec4(p, 1.0);
            const glm::dvec2 drawn = glm::dvec2(clip) / clip.w * 0.5 + 0.5;
            EXPECT_LT(glm::length(drawn - expected), 1e-9);
            EXPECT_TRUE(glm::all(glm::greaterThan(drawn, glm::dvec2(0.0))) &&
                        glm::all(glm::lessThan(drawn, glm::dvec2(1.0))));
          }
        }
      }
    }
  }
}

// Maps of a row of posts are as wide as the atlas, one above the other.
TEST(SliceSpace, TilesAreAsWideAsTheirContent) {
  const scene::AreaLight light = lightAt({0, 12, 0.01}, 2.0, 2.0);
  const planner::SubLightGrid grid{2, 2};
  const auto tilesFor = [&](const glm::dvec3& half) {
    const std::vector<glm::dvec3> points = casterPoints(-half, half, 40, 3);
    const planner::SubLights split =
        planner::fitSubLights(light, points, grid, planner::subLightMapSize(grid, 1024));
    return spaceOf(planner::fitLight(light, points, {}), points, {.grid = grid}, &split)->tiles;
  };
  EXPECT_EQ(tilesFor({3, 1, 3}), glm::ivec2(2, 2));
  const glm::ivec2 alongX = tilesFor({6, 1, 0.2}), alongZ = tilesFor({0.2, 1, 6});
  EXPECT_EQ(alongX.x * alongX.y, 4);
  EXPECT_NE(alongX, glm::ivec2(2, 2));
  EXPECT_EQ(alongZ, glm::ivec2(alongX.y, alongX.x));
}

}  // namespace
}  // namespace halfshadow::techniques
