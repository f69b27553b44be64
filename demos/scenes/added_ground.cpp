// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/added_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace halfshadow::scenes {
namespace {
/// Rounding of a coordinate to float, twice.
constexpr double kFloat = 1.0 / (1 << 22);
/// Of the scene's radius: far below what is seen of it, far above what a depth buffer confuses.
constexpr double kGap = 1e-3;
/// Surfaces at the ground's height that are looked at, the largest first.
constexpr std::size_t kMostLookedAt = 256;

struct WorldTriangle {
  std::array<glm::dvec3, 3> corners;
  std::uint32_t object = 0, shell = scene::kNoShell;
};

std::vector<WorldTriangle> trianglesOf(const scene::SceneDescription& description) {
  std::vector<WorldTriangle> triangles;
  for (std::uint32_t o = 0; o < description.objects.size(); ++o) {
    const scene::SceneObject& object = description.objects[o];
    const scene::TriangleMesh& mesh = *object.mesh;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      WorldTriangle triangle{.object = o, .shell = mesh.shellOf.empty() ? scene::kNoShell : mesh.shellOf[t]};
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.corners[k] = glm::dvec3(
            object.worldFromObject * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[3 * t + k]]), 1.0));
      }
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

/// 4 pi inside a closed shell, 0 outside, either sign.
double solidAngle(const WorldTriangle& triangle, const glm::dvec3& point) {
  const glm::dvec3 a = triangle.corners[0] - point, b = triangle.corners[1] - point,
                   c = triangle.corners[2] - point;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  return 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

bool isInsideAShell(const std::vector<WorldTriangle>& triangles, const glm::dvec3& point) {
  // Triangles of one shell need not follow each other: sums by shell, one object at a time.
  std::vector<double> sums;
  for (std::size_t first = 0, last; first < triangles.size(); first = last) {
    sums.clear();
    for (last = first; last < triangles.size() && triangles[last].object == triangles[first].object; ++last) {
      const std::uint32_t shell = triangles[last].shell;
      if (shell == scene::kNoShell) continue;
      if (shell >= sums.size()) sums.resize(shell + 1, 0.0);
      sums[shell] += solidAngle(triangles[last], point);
    }
    if (std::ranges::any_of(sums, [](double sum) { return std::abs(sum) > 6.0; })) return true;  // about 2 pi
  }
  return false;
}

double areaOf(const WorldTriangle& t) {
  return 0.5 * glm::length(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
}

/// Does anything but `own` lie on the way from the eye to `point`?
bool isHidden(const std::vector<WorldTriangle>& triangles, const WorldTriangle& own, const glm::dvec3& eye,
              const glm::dvec3& point) {
  const glm::dvec3 way = point - eye;
  return std::ranges::any_of(triangles, [&](const WorldTriangle& triangle) {
    if (&triangle == &own) return false;
    const glm::dvec3 ab = triangle.corners[1] - triangle.corners[0],
                     ac = triangle.corners[2] - triangle.corners[0];
    const glm::dvec3 p = glm::cross(way, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0.0) return false;
    const glm::dvec3 toEye = eye - triangle.corners[0];
    const double u = glm::dot(toEye, p) / determinant;
    const glm::dvec3 q = glm::cross(toEye, ab);
    const double v = glm::dot(way, q) / determinant, share = glm::dot(ac, q) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && share > 0.0 && share < 1.0 - 1e-6;
  });
}

/// Area of the surfaces in the plane at `height` that the eye sees, judged at their centres.
double seenAreaAt(const std::vector<WorldTriangle>& triangles, double height, double rounding,
                  const glm::dvec3& eye) {
  std::vector<const WorldTriangle*> there;
  for (const WorldTriangle& triangle : triangles) {
    if (std::ranges::all_of(triangle.corners, [&](const glm::dvec3& c) { return c.y <= height + rounding; }))
      there.push_back(&triangle);
  }
  std::ranges::sort(there, [](const auto* a, const auto* b) { return areaOf(*a) > areaOf(*b); });
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
      visible += !isHidden(triangles, *triangle, eye, point);
    }
    if (visible > 0) seen += areaOf(*triangle);
  }
  return seen;
}
}  // namespace

GroundPlace groundPlaceFor(const scene::SceneDescription& description) {
  const std::vector<WorldTriangle> triangles = trianglesOf(description);
  scene::Bounds bounds;
  for (const WorldTriangle& triangle : triangles) {
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
  if (isInsideAShell(triangles, eye)) {
    return {.height = lowest,
            .wanted = false,
            .note = "no ground was added: the camera is inside a closed object"};
  }
  const double seen = seenAreaAt(triangles, lowest, rounding, eye);
  if (seen <= 0.0) return {.height = lowest};
  const double below = lowest - kGap * bounds.radius();
  const glm::dvec3 size = bounds.high - bounds.low;
  if (seen >= 0.5 * size.x * size.z) {
    return {.height = below,
            .wanted = false,
            .note = "no ground was added: a surface at the scene's lowest point is its floor"};
  }
  return {
      .height = below,
      .note = "it lies a little below a surface at the scene's lowest point, which would else hide in it"};
}

}  // namespace halfshadow::scenes
