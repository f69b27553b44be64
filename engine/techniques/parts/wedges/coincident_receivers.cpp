// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/wedges/coincident_receivers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace halfshadow::techniques {
namespace {
/// Of a coordinate: a vertex rounded to single precision, by a matrix rounded likewise.
constexpr double kRoundings = 4.0 / (1 << 24);
/// What is known of pairs is forgotten when it becomes so much.
constexpr std::size_t kMostPairs = 4096;

struct Triangle {
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 normal{0.0};  ///< unit
  scene::Bounds bounds;
  double rounding = 0.0;  ///< of its corners, world length
};

std::vector<Triangle> trianglesOf(const DrawItem& item) {
  std::vector<Triangle> triangles;
  const scene::TriangleMesh& mesh = *item.sourceMesh;
  const glm::dvec3 origin(item.worldFromObject[3]);
  const double shift = std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)});
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p(item.worldFromObject * glm::dvec4(mesh.positions[mesh.indices[i + k]], 1.0));
      triangle.corners[k] = p;
      triangle.bounds.include(p);
      const double reach = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), shift});
      triangle.rounding = std::max(triangle.rounding, kRoundings * reach);
    }
    const glm::dvec3 cross =
        glm::cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
    const double length = glm::length(cross);
    if (!(length > 0.0)) continue;
    triangle.normal = cross / length;
    triangles.push_back(triangle);
  }
  return triangles;
}

bool inPlane(const Triangle& plane, const Triangle& other) {
  return std::ranges::all_of(other.corners, [&](const glm::dvec3& p) {
    return std::abs(glm::dot(plane.normal, p - plane.corners[0])) <= plane.rounding + other.rounding;
  });
}

/// Of triangles in one plane: whether no edge of either separates them.
bool overlap(const Triangle& a, const Triangle& b) {
  const double margin = a.rounding + b.rounding;
  for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 edge = own->corners[(k + 1) % 3] - own->corners[k];
      const glm::dvec3 inwards = glm::normalize(glm::cross(own->normal, edge));
      const glm::dvec3& corner = own->corners[k];
      const bool apart = std::ranges::all_of(
          other->corners, [&](const glm::dvec3& p) { return glm::dot(inwards, p - corner) <= margin; });
      if (apart) return false;
    }
  }
  return true;
}
}  // namespace

bool surfacesCoincide(const DrawItem& a, const DrawItem& b) {
  const bool same = a.object == b.object;
  const std::vector<Triangle> first = trianglesOf(a), second = same ? first : trianglesOf(b);
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t k = 0; k < (same ? i : second.size()); ++k) {
      const Triangle &p = first[i], &q = second[k];
      if (p.bounds.meets(q.bounds, p.rounding + q.rounding) && (inPlane(p, q) || inPlane(q, p)) &&
          overlap(p, q))
        return true;
    }
  }
  return false;
}

bool CoincidentReceivers::coincide(const DrawItem& a, const DrawItem& b) {
  Known& known = known_[{a.object, b.object}];
  if (known.revisionA != a.revision || known.revisionB != b.revision)
    known = {a.revision, b.revision, surfacesCoincide(a, b)};
  return known.coincide;
}

bool CoincidentReceivers::compare(const DrawItem& a, const DrawItem& b, double rounding) {
  if (!a.boundsWorld.meets(b.boundsWorld, rounding)) return false;
  if (hasFewTriangles(a) && hasFewTriangles(b)) return coincide(a, b);
  const glm::dvec3 low = glm::abs(a.boundsWorld.low - b.boundsWorld.low),
                   high = glm::abs(a.boundsWorld.high - b.boundsWorld.high);
  const glm::dvec3 apart = glm::max(low, high);
  return std::max({apart.x, apart.y, apart.z}) <= rounding;
}

bool CoincidentReceivers::among(std::span<const DrawItem> receivers) {
  if (known_.size() > kMostPairs) known_.clear();
  struct Listed {
    std::size_t place = 0;
    double rounding = 0.0;
  };
  std::vector<Listed> byLowX;
  double coarsest = 0.0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const scene::Bounds& box = receivers[i].boundsWorld;
    if (hasFewTriangles(receivers[i]) && coincide(receivers[i], receivers[i])) return true;
    const glm::dvec3 size = glm::max(glm::abs(box.low), glm::abs(box.high));
    byLowX.push_back({i, 2.0 * kRoundings * std::max({size.x, size.y, size.z})});
    coarsest = std::max(coarsest, byLowX.back().rounding);
  }
  // Along x, so that only those are compared whose boxes overlap there.
  std::ranges::sort(byLowX, {}, [&](const Listed& at) { return receivers[at.place].boundsWorld.low.x; });
  for (std::size_t i = 0; i < byLowX.size(); ++i) {
    const DrawItem& a = receivers[byLowX[i].place];
    for (std::size_t k = i + 1; k < byLowX.size(); ++k) {
      const DrawItem& b = receivers[byLowX[k].place];
      if (b.boundsWorld.low.x > a.boundsWorld.high.x + coarsest) break;
      const Listed& later = byLowX[i].place > byLowX[k].place ? byLowX[i] : byLowX[k];
      if (compare(a, b, later.rounding)) return true;
    }
  }
  return false;
}

}  // namespace halfshadow::techniques
