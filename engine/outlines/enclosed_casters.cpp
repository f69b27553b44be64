// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/enclosed_casters.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "scene/bounds.hpp"

namespace halfshadow::outlines {
namespace {

double heightOver(const scene::HalfEdgeMesh& mesh, const glm::vec4& plane, const glm::dvec3& pointObject) {
  return glm::dot(glm::dvec3(plane), pointObject - mesh.origin()) + static_cast<double>(plane.w);
}

bool isConvexBody(const scene::PlacedCaster& caster) {
  const auto parts = caster.mesh->parts();
  return parts.size() == 1 && parts[0].closed && parts[0].convex;
}

/// Whether some face has all of the light on its outer side.
bool lightIsOutside(const scene::PlacedCaster& body, const scene::AreaLight& light) {
  const glm::dmat4 objectFromWorld = glm::inverse(body.worldFromObject);
  std::array<glm::dvec3, 4> corners;
  for (int k = 0; k < 4; ++k) {
    const glm::dvec3 corner =
        light.centerWorld + (k & 1 ? 1.0 : -1.0) * light.halfU + (k & 2 ? 1.0 : -1.0) * light.halfV;
    corners[static_cast<std::size_t>(k)] = glm::dvec3(objectFromWorld * glm::dvec4(corner, 1.0));
  }
  return std::ranges::any_of(body.mesh->facePlanes(), [&](const glm::vec4& plane) {
    return std::ranges::all_of(
        corners, [&](const glm::dvec3& corner) { return heightOver(*body.mesh, plane, corner) > 0.0; });
  });
}

bool isInside(const scene::PlacedCaster& caster, const scene::PlacedCaster& body) {
  const glm::dmat4 bodyFromObject = glm::inverse(body.worldFromObject) * caster.worldFromObject;
  return std::ranges::all_of(caster.mesh->positions(), [&](const glm::vec3& position) {
    const glm::dvec3 point(bodyFromObject * glm::dvec4(glm::dvec3(position), 1.0));
    return std::ranges::all_of(body.mesh->facePlanes(), [&](const glm::vec4& plane) {
      return heightOver(*body.mesh, plane, point) < 0.0;
    });
  });
}

scene::Bounds boundsWorld(const scene::PlacedCaster& caster) {
  scene::Bounds bounds;
  for (const scene::CasterPart& part : caster.mesh->parts())
    bounds.include(scene::transformed(caster.worldFromObject, part.bounds));
  return bounds;
}

bool contains(const scene::Bounds& outer, const scene::Bounds& inner) {
  return glm::all(glm::lessThan(outer.low, inner.low)) && glm::all(glm::greaterThan(outer.high, inner.high));
}
}  // namespace

std::vector<bool> enclosedCasters(std::span<const scene::PlacedCaster> casters,
                                  const scene::AreaLight& light) {
  std::vector<bool> enclosed(casters.size(), false);
  std::vector<scene::Bounds> bounds;
  for (const scene::PlacedCaster& caster : casters) bounds.push_back(boundsWorld(caster));
  // The smallest that encloses a caster is likely the first that is asked.
  std::vector<std::uint32_t> bodies;
  for (std::uint32_t k = 0; k < casters.size(); ++k) {
    if (isConvexBody(casters[k])) bodies.push_back(k);
  }
  std::ranges::sort(bodies, {}, [&](std::uint32_t k) { return bounds[k].radius(); });
  std::vector<signed char> hides(casters.size(), -1);  // not known yet
  for (std::size_t k = 0; k < casters.size(); ++k) {
    for (const std::uint32_t body : bodies) {
      if (body == k || !contains(bounds[body], bounds[k])) continue;
      if (hides[body] < 0) hides[body] = lightIsOutside(casters[body], light) ? 1 : 0;
      enclosed[k] = hides[body] == 1 && isInside(casters[k], casters[body]);
      if (enclosed[k]) break;
    }
  }
  return enclosed;
}

}  // namespace halfshadow::outlines
