// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/enclosure.hpp"

#include <cmath>

namespace halfshadow::scene {
namespace {
bool within(const Bounds& bounds, const glm::dvec3& p) {
  return glm::all(glm::greaterThanEqual(p, bounds.low)) && glm::all(glm::lessThanEqual(p, bounds.high));
}

/// Winding number of a closed part around a point, from the faces' solid angles.
/// Based on: Van Oosterom, Strackee, "The Solid Angle of a Plane Triangle", 1983.
double windingNumber(const HalfEdgeMesh& mesh, const CasterPart& part, const glm::dvec3& point) {
  double sum = 0.0;
  for (std::uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
    const glm::uvec3& face = mesh.faces()[f];
    const glm::dvec3 a = glm::dvec3(mesh.positions()[face.x]) - point;
    const glm::dvec3 b = glm::dvec3(mesh.positions()[face.y]) - point;
    const glm::dvec3 c = glm::dvec3(mesh.positions()[face.z]) - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum / (2.0 * 3.14159265358979323846);
}

/// Whether some face may meet the near plane's rectangle: none lies wholly on one side of one of the view's
/// planes.
bool cutsNearPlane(const HalfEdgeMesh& mesh, const CasterPart& part, const glm::dmat4& clipFromObject) {
  for (std::uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
    unsigned allBefore = 1, allBeyond = 1, allOutside = 15;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec4 p = clipFromObject * glm::dvec4(glm::dvec3(mesh.positions()[mesh.faces()[f][k]]), 1.0);
      allBefore &= p.z < -p.w ? 1u : 0u;
      allBeyond &= p.z > -p.w ? 1u : 0u;
      allOutside &=
          (p.x > p.w ? 1u : 0u) | (p.x < -p.w ? 2u : 0u) | (p.y > p.w ? 4u : 0u) | (p.y < -p.w ? 8u : 0u);
    }
    if (allBefore + allBeyond + allOutside == 0) return true;
  }
  return false;
}
}  // namespace

bool enclosesPoint(const HalfEdgeMesh& mesh, const CasterPart& part, const glm::dvec3& pointObject) {
  return part.closed && within(part.bounds, pointObject) && windingNumber(mesh, part, pointObject) > 0.5;
}

PartSide sideSeenFrom(const HalfEdgeMesh& mesh, const CasterPart& part, const glm::dmat4& clipFromObject) {
  const glm::dmat4 objectFromClip = glm::inverse(clipFromObject);
  Bounds near;
  for (int k = 0; k < 4; ++k) {
    const glm::dvec4 corner = objectFromClip * glm::dvec4(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, -1.0, 1.0);
    near.include(glm::dvec3(corner) / corner.w);
  }
  if (glm::any(glm::greaterThan(near.low, part.bounds.high)) ||
      glm::any(glm::lessThan(near.high, part.bounds.low))) {
    return PartSide::outside;
  }
  if (cutsNearPlane(mesh, part, clipFromObject)) return PartSide::unsure;
  const glm::dvec4 middle = objectFromClip * glm::dvec4(0.0, 0.0, -1.0, 1.0);
  return enclosesPoint(mesh, part, glm::dvec3(middle) / middle.w) ? PartSide::inside : PartSide::outside;
}

}  // namespace halfshadow::scene
