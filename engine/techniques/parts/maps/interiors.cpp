// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/interiors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace halfshadow::techniques {
namespace {
/// More are not looked at: the walls of a room are few.
constexpr std::size_t kMostTriangles = 128;
/// Rounding of a place that was computed in single precision, relative to its coordinates.
constexpr double kRounding = 1.0 / (1 << 20);
/// Sine between two walls: less is one wall in two pieces.
constexpr double kLeastAngle = 0.1;
/// Share of all casters' size that their common edge is long: the light along it is as wide as some texels of
/// the map, which hold all casters.
constexpr double kLeastEdge = 0.2;

double largestCoordinate(const scene::Bounds& bounds) {
  const glm::dvec3 most = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return std::max({most.x, most.y, most.z});
}

bool eyeIsInside(const LightScene& scene, const DrawItem& caster) {
  const glm::dvec3& eye = scene.screen.eyeWorld;
  if (!caster.closed || !caster.receives || caster.sourceMesh == nullptr) return false;
  if (glm::any(glm::lessThan(eye, caster.boundsWorld.low)) ||
      glm::any(glm::greaterThan(eye, caster.boundsWorld.high))) {
    return false;
  }
  const glm::dmat4 objectFromWorld = glm::inverse(caster.worldFromObject);
  return parts(*caster.sourceMesh, glm::dvec3(objectFromWorld * glm::dvec4(eye, 1.0)),
               glm::dvec3(objectFromWorld * glm::dvec4(scene.light.centerWorld, 1.0)));
}

struct WallTriangle {
  std::array<glm::dvec3, 3> cornersWorld;
  glm::dvec3 normal;  ///< unit length
  scene::Bounds boundsWorld;
  double side(const glm::dvec3& point) const { return glm::dot(normal, point - cornersWorld[0]); }
};

void addWalls(const DrawItem& item, std::vector<WallTriangle>& walls) {
  if (item.closed || item.sourceMesh == nullptr) return;
  const scene::TriangleMesh& mesh = *item.sourceMesh;
  if (mesh.triangleCount() > kMostTriangles) return;
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    WallTriangle wall{};
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 position(mesh.positions[mesh.indices[t + k]]);
      wall.cornersWorld[k] = glm::dvec3(item.worldFromObject * glm::dvec4(position, 1.0));
      wall.boundsWorld.include(wall.cornersWorld[k]);
    }
    const auto& [a, b, c] = wall.cornersWorld;
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    if (!(glm::length(cross) > 0.0)) continue;
    wall.normal = glm::normalize(cross);
    walls.push_back(wall);
  }
}

/// They meet at an angle, over at least `length`, and `caster` is between the light and all of `receiver`.
bool hides(const WallTriangle& caster, const WallTriangle& receiver, const glm::dvec3& lightWorld,
           double length) {
  if (glm::length(glm::cross(caster.normal, receiver.normal)) <= kLeastAngle) return false;
  const scene::Bounds &a = caster.boundsWorld, &b = receiver.boundsWorld;
  const double slack = kRounding * std::max(largestCoordinate(a), largestCoordinate(b));
  const glm::dvec3 low = glm::max(a.low, b.low), high = glm::min(a.high, b.high);
  if (glm::any(glm::greaterThan(low, high + slack)) || glm::length(high - low) < length) return false;
  const double light = caster.side(lightWorld);
  int touching = 0;
  for (const glm::dvec3& corner : receiver.cornersWorld) {
    const double side = light > 0.0 ? caster.side(corner) : -caster.side(corner);
    if (side > slack) return false;
    touching += side >= -slack;
  }
  return touching > 0;
}

/// A room with a wall that the light does not see the inside of, however its walls are split into meshes.
bool wallsHideWalls(const LightScene& scene) {
  std::vector<WallTriangle> casters, receivers;
  scene::Bounds all;
  for (const DrawItem& item : scene.casters) {
    all.include(item.boundsWorld);
    addWalls(item, casters);
    if (casters.size() > kMostTriangles) return false;
  }
  if (casters.empty()) return false;
  // Walls that shadow nothing are no casters of this light.
  for (const DrawItem& item : scene.receivers) {
    addWalls(item, receivers);
    if (receivers.size() > kMostTriangles) return false;
  }
  const double length = kLeastEdge * 2.0 * all.radius();
  return std::ranges::any_of(casters, [&](const WallTriangle& caster) {
    return std::ranges::any_of(receivers, [&](const WallTriangle& receiver) {
      return hides(caster, receiver, scene.light.centerWorld, length);
    });
  });
}
}  // namespace

bool parts(const scene::TriangleMesh& mesh, const glm::dvec3& from, const glm::dvec3& to) {
  const auto place = [&](std::uint32_t vertex) { return glm::dvec3(mesh.positions[vertex]); };
  const auto volume = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    return glm::dot(b - a, glm::cross(c - a, d - a));
  };
  // On which side the segment passes an edge: computed alike for the triangles on both its sides, so that a
  // segment through the edge passes one of them.
  const auto side = [&](std::uint32_t i, std::uint32_t j) {
    return i < j ? volume(from, to, place(i), place(j)) >= 0.0 : volume(from, to, place(j), place(i)) < 0.0;
  };
  bool parted = false;
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    std::array<std::uint32_t, 3> v;
    for (std::size_t k = 0; k < 3; ++k) {
      v[k] = mesh.indices[t + k];
      if (v[k] < mesh.weldedVertex.size()) v[k] = mesh.weldedVertex[v[k]];
    }
    const bool first = side(v[0], v[1]);
    if (side(v[1], v[2]) != first || side(v[2], v[0]) != first) continue;
    const bool fromBefore = volume(from, place(v[0]), place(v[1]), place(v[2])) >= 0.0;
    const bool toBefore = volume(to, place(v[0]), place(v[1]), place(v[2])) >= 0.0;
    parted = parted != (fromBefore != toBefore);
  }
  return parted;
}

std::optional<StandIn> standInForInteriors(const LightScene& scene) {
  if (std::ranges::any_of(scene.casters, [&](const DrawItem& item) { return eyeIsInside(scene, item); })) {
    return StandIn{
        "sampled",
        "seen-from-within: the camera is inside a closed caster that the light is outside of, whose "
        "walls a blur of fixed width lights along their upper edges"};
  }
  if (wallsHideWalls(scene)) {
    return StandIn{"sampled",
                   "walls-meet: a wall hides another from the light that it meets, and a blur of fixed width "
                   "lights that one along their common edge"};
  }
  return std::nullopt;
}

}  // namespace halfshadow::techniques
