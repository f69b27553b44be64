// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/added_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace halfshadow::scenes {
namespace {
/// Rounding of a coordinate to float, twice.
constexpr double kFloat = 1.0 / (1 << 22);
/// Of the scene's radius: far below what is seen of it, far above what a depth buffer confuses.
constexpr double kGap = 1e-3;
/// Surfaces at the ground's height that are looked at, the largest first.
constexpr std::size_t kMostLookedAt = 256;
/// Of the scene's width times its depth: what is seen of a surface at its lowest point and is its floor.
constexpr double kFloorShare = 0.25;

/// 4 pi inside a closed shell, 0 outside, either sign.
double solidAngle(const WorldTriangle& triangle, const glm::dvec3& point) {
  const glm::dvec3 a = triangle.corners[0] - point, b = triangle.corners[1] - point,
                   c = triangle.corners[2] - point;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  return 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

bool isInsideAShell(const std::vector<WorldTriangle>& triangles, const glm::dvec3& point) {
  // Triangles of one shell need not follow each other: sums by object and shell.
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> sums;
  for (const WorldTriangle& triangle : triangles) {
    if (triangle.shell != scene::kNoShell)
      sums[{triangle.object, triangle.shell}] += solidAngle(triangle, point);
  }
  return std::ranges::any_of(sums, [](const auto& sum) { return std::abs(sum.second) > 6.0; });  // about 2 pi
}

/// Area of the surfaces in the plane at `height` that the camera sees, judged at their centres.
double seenAreaAt(const TriangleTree& tree, double height, double rounding, const scene::Camera& camera) {
  const auto liesThere = [&](const WorldTriangle& triangle) {
    return std::ranges::all_of(triangle.corners,
                               [&](const glm::dvec3& c) { return c.y <= height + rounding; });
  };
  if (std::ranges::none_of(tree.triangles(), liesThere)) return 0.0;
  tree.order();
  std::vector<const WorldTriangle*> there;
  for (const WorldTriangle& triangle : tree.triangles()) {
    if (liesThere(triangle)) there.push_back(&triangle);
  }
  std::ranges::sort(there, [](const auto* a, const auto* b) { return a->area() > b->area(); });
  if (there.size() > kMostLookedAt) there.resize(kMostLookedAt);
  double seen = 0.0;
  for (const WorldTriangle* triangle : there) {
    // Several points: what stands on a floor hides some of it.
    int visible = 0;
    constexpr std::array<glm::dvec3, 4> kPoints{glm::dvec3(1, 1, 1) / 3.0, glm::dvec3(.8, .1, .1),
                                                glm::dvec3(.1, .8, .1), glm::dvec3(.1, .1, .8)};
    for (const glm::dvec3& share : kPoints) {
      const glm::dvec3 point =
          triangle->corners[0] * share.x + triangle->corners[1] * share.y + triangle->corners[2] * share.z;
      const auto begin = scene::sightBegin(camera, point);
      visible += begin && !tree.isBetween(*begin, point, triangle);
    }
    if (visible > 0) seen += triangle->area();
  }
  return seen;
}
}  // namespace

GroundPlace groundPlaceFor(const scene::SceneDescription& description, const TriangleTree& tree) {
  scene::Bounds bounds;
  for (const WorldTriangle& triangle : tree.triangles()) {
    for (const glm::dvec3& corner : triangle.corners) bounds.include(corner);
  }
  const double lowest = bounds.low.y;
  const double rounding = kFloat * std::max(std::abs(bounds.low.y), std::abs(bounds.high.y));
  const glm::dvec3& eye = description.camera->eyeWorld;
  if (eye.y <= lowest + rounding) {
    return {.height = lowest,
            .wanted = false,
            .note = "no ground was added: the camera is not above the scene's lowest point"};
  }
  for (const scene::AreaLight& light : description.lights) {
    if (light.centerWorld.y - std::abs(light.halfU.y) - std::abs(light.halfV.y) <= lowest + rounding) {
      return {.height = lowest,
              .wanted = false,
              .note = "no ground was added: a light is not above the scene's lowest point"};
    }
  }
  const auto begin = scene::sightBegin(*description.camera, description.camera->targetWorld);
  const glm::dvec3 from = begin.value_or(eye);
  const bool isAmong =
      glm::all(glm::lessThanEqual(bounds.low, from)) && glm::all(glm::lessThanEqual(from, bounds.high));
  if (isAmong && isInsideAShell(tree.triangles(), from)) {
    return {.height = lowest,
            .wanted = false,
            .note = "no ground was added: the camera is inside a closed object"};
  }
  const double seen = seenAreaAt(tree, lowest, rounding, *description.camera);
  if (seen <= 0.0) return {.height = lowest};
  const double below = lowest - kGap * bounds.radius();
  const glm::dvec3 size = bounds.high - bounds.low;
  if (seen >= kFloorShare * size.x * size.z) {
    return {.height = below,
            .wanted = false,
            .note = "no ground was added: a surface at the scene's lowest point is its floor"};
  }
  return {
      .height = below,
      .note = "it lies a little below a surface at the scene's lowest point, which would else hide in it"};
}

}  // namespace halfshadow::scenes
