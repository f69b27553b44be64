// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/sub_lights.hpp"

#include <algorithm>
#include <cmath>

#include "planner/light_space.hpp"

namespace halfshadow::planner {
namespace {
// Sides are this, the next or the one after, times a power of two: whatever is halved from them down to five
// cells or less divides evenly.
constexpr int kCoarsestCells = 4, kMostCoarsestCells = 6;
// Times as many texels at most as were asked for, where the next side of that kind asks for some more: 1152
// in place of 960 for three maps a row in 1024.
constexpr double kMostTexelsShare = 1.3;
// Pyramids over a map begin with cells of 4 texels and need a few levels.
constexpr int kSmallestMap = 64;
glm::dmat4 translated(const glm::dvec2& offset) {
  glm::dmat4 matrix(1.0);
  matrix[3] = glm::dvec4(-offset, 0.0, 1.0);
  return matrix;
}
}  // namespace

int SubLightGrid::tilesPerSide() const {
  int side = 1;
  while (side * side < count()) ++side;
  return side;
}

SubLightGrid subLightGrid(const scene::AreaLight& light, int perSide) {
  const double u = glm::length(light.halfU), v = glm::length(light.halfV);
  const double longer = std::max(u, v);
  if (!(longer > 0.0)) return {};
  const auto along = [&](double side) {
    const double share = perSide * side / longer;
    // An odd number stays odd, so that there is a sub-light in the middle.
    const long count = perSide % 2 == 0 ? std::lround(share) : 2 * std::lround(0.5 * (share - 1.0)) + 1;
    return std::clamp(static_cast<int>(count), 1, perSide);
  };
  return {along(u), along(v)};
}

int subLightMapSize(const SubLightGrid& grid, int mapSize, int mostTexels) {
  if (grid.whole()) return mapSize;
  const int texels = std::min(static_cast<int>(std::sqrt(kMostTexelsShare) * mapSize), mostTexels);
  const int most = texels / grid.tilesPerSide();
  if (most < kSmallestMap) return 0;
  int step = 1;
  while (step * 2 * kCoarsestCells <= most) step *= 2;
  return std::min(most / step, kMostCoarsestCells) * step;
}

SubLights fitSubLights(const scene::AreaLight& light, std::span<const glm::dvec3> casterPointsWorld,
                       const SubLightGrid& grid, int side) {
  const CasterShape all{.pointsWorld = casterPointsWorld};
  LightFitter fitter;
  return fitSubLights(light, {&all, 1}, grid, side, fitter);
}

SubLights fitSubLights(const scene::AreaLight& light, std::span<const CasterShape> casters,
                       const SubLightGrid& grid, int side, LightFitter& fitter, const ListChanges& changes) {
  const LightSpace space = lightSpace(light);
  const auto inPlane = [&](const glm::dvec3& vector) {
    return glm::dvec2(glm::dot(space.axisX, vector), glm::dot(space.axisY, vector));
  };
  SubLights lights{.grid = grid};
  const glm::dvec2 halfU = inPlane(light.halfU), halfV = inPlane(light.halfV);
  const glm::dvec2 shareU = halfU / static_cast<double>(grid.alongU);
  const glm::dvec2 shareV = halfV / static_cast<double>(grid.alongV);
  lights.halfSize = glm::abs(shareU) + glm::abs(shareV);
  lights.stepU = 2.0 * shareU;
  lights.stepV = 2.0 * shareV;
  const glm::dvec2 spread = glm::abs(halfU - shareU) + glm::abs(halfV - shareV);
  lights.shared =
      fitter.fit(light, casters, {.mapSize = side, .nearShare = 0.0, .centerSpread = spread}, changes);
  if (lights.shared.empty) return lights;
  for (int j = 0; j < grid.alongV; ++j) {
    for (int i = 0; i < grid.alongU; ++i) {
      const glm::dvec2 center =
          (i - 0.5 * (grid.alongU - 1)) * lights.stepU + (j - 0.5 * (grid.alongV - 1)) * lights.stepV;
      LightFit& fit = lights.fits.emplace_back(lights.shared);
      fit.halfSize = lights.halfSize;
      fit.lightFromWorld = translated(center) * fit.lightFromWorld;
      fit.tangentLow -= center / lights.shared.alignedDistance;
      fit.tangentHigh -= center / lights.shared.alignedDistance;
    }
  }
  return lights;
}

SubLightChoice chooseSubLights(const SubLightNeeds& needs) {
  const auto texels = std::to_string(std::lround(needs.widestPenumbraTexels));
  if (needs.widestPenumbraTexels < needs.worthSplitting)
    return {1, "penumbra-narrow: the widest is " + texels +
                   " texels wide, and a sub-light's map would be coarser"};
  return {needs.perSide, "penumbra-wide: the widest is " + texels +
                             " texels wide in one map, which sees all of it from one point of the light"};
}

}  // namespace halfshadow::planner
