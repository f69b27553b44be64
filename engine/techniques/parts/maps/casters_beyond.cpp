// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "techniques/parts/maps/light_blocks.hpp"

namespace halfshadow::techniques {
namespace {
/// More vertices are not looked at: floors have few.
constexpr std::size_t kMostVertices = 64;
/// Rounding of a place that was computed in single precision, relative to its coordinates: casters that stand
/// on a floor do not reach through it.
constexpr double kRounding = 1.0 / (1 << 20);

double largestCoordinate(const glm::dvec3& point) {
  return std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
}

struct Plane {
  glm::dvec3 normal{0.0};  ///< unit length, towards the light; zero: none
  glm::dvec3 point{0.0};

  /// Positive on the light's side, zero within rounding.
  double side(const glm::dvec3& at) const {
    const double height = glm::dot(normal, at - point);
    return std::abs(height) <= kRounding * (largestCoordinate(at) + largestCoordinate(point)) ? 0.0 : height;
  }
};

/// Of the first triangle that has an area, turned to the light, when all vertices lie in it.
Plane planeOf(const DrawItem& receiver, const glm::dvec3& lightWorld) {
  const scene::TriangleMesh& mesh = *receiver.sourceMesh;
  if (mesh.positions.size() > kMostVertices) return {};
  const auto place = [&](std::uint32_t index) {
    return glm::dvec3(receiver.worldFromObject * glm::dvec4(glm::dvec3(mesh.positions[index]), 1.0));
  };
  Plane plane;
  for (std::size_t i = 0; i + 2 < mesh.indices.size() && plane.normal == glm::dvec3(0.0); i += 3) {
    const glm::dvec3 a = place(mesh.indices[i]);
    const glm::dvec3 cross = glm::cross(place(mesh.indices[i + 1]) - a, place(mesh.indices[i + 2]) - a);
    if (glm::length(cross) > 0.0) plane = {glm::normalize(cross), a};
  }
  if (glm::dot(plane.normal, lightWorld - plane.point) < 0.0) plane.normal = -plane.normal;
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    if (plane.side(place(i)) != 0.0) return {};
  }
  return plane;
}

/// The box settles most; where it reaches through a plane that its caster only stands on, by its slant, the
/// caster's own vertices do, so that turning a scene changes no answer.
bool reachesBeyond(const DrawItem& caster, const Plane& plane) {
  const auto isBeyond = [&](const glm::dvec3& point) { return plane.side(point) < 0.0; };
  const auto corners = caster.boundsWorld.corners();
  if (std::ranges::none_of(corners, isBeyond)) return false;
  if (caster.sourceMesh == nullptr) return true;
  return std::ranges::any_of(caster.sourceMesh->positions, [&](const glm::vec3& position) {
    return isBeyond(glm::dvec3(caster.worldFromObject * glm::dvec4(glm::dvec3(position), 1.0)));
  });
}

/// Is all of the caster beyond the plane, and behind the receiver as seen from the light's centre?
bool liesBehind(const DrawItem& caster, const DrawItem& receiver, const Plane& plane,
                const glm::dvec3& lightWorld) {
  scene::Bounds image;
  const double lightHeight = plane.side(lightWorld);
  for (const glm::dvec3& corner : caster.boundsWorld.corners()) {
    const double height = plane.side(corner);
    if (height >= 0.0 || !(lightHeight > 0.0)) return false;
    image.include(lightWorld + (corner - lightWorld) * (lightHeight / (lightHeight - height)));
  }
  const scene::Bounds& bounds = receiver.boundsWorld;
  const double slack = kRounding * largestCoordinate(glm::max(glm::abs(bounds.low), glm::abs(bounds.high)));
  return glm::all(glm::lessThanEqual(image.low, bounds.high + slack)) &&
         glm::all(glm::lessThanEqual(bounds.low, image.high + slack));
}
}  // namespace

bool hasCastersBehindReceivers(const LightScene& scene) {
  return std::ranges::any_of(scene.receivers, [&](const DrawItem& receiver) {
    if (receiver.casts || receiver.sourceMesh == nullptr) return false;
    const Plane plane = planeOf(receiver, scene.light.centerWorld);
    return plane.normal != glm::dvec3(0.0) && std::ranges::any_of(scene.casters, [&](const DrawItem& caster) {
             return liesBehind(caster, receiver, plane, scene.light.centerWorld);
           });
  });
}

bool mayHaveCastersBeyond(const LightScene& scene, const DrawItem& receiver) {
  if (receiver.sourceMesh == nullptr) return true;
  const Plane plane = planeOf(receiver, scene.light.centerWorld);
  if (plane.normal == glm::dvec3(0.0)) return true;
  return std::ranges::any_of(scene.casters,
                             [&](const DrawItem& caster) { return reachesBeyond(caster, plane); });
}

void addSelfReceiverSearch(const LightScene& scene, ReceiverShading& shading) {
  shading.defines.push_back("HS_SEARCH 5");
  shading.selfReceivers = ReceiverShading::SelfReceivers::casting;
  for (const DrawItem& receiver : scene.receivers) {
    if (!receiver.casts && mayHaveCastersBeyond(scene, receiver))
      shading.alsoCasting.push_back(receiver.object);
  }
}

}  // namespace halfshadow::techniques
