// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "reference/caster_shafts.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::reference {
namespace {

constexpr std::uint32_t kTrianglesPerLeaf = 4;

/// The half-space dot(normal, x) <= offset, enlarged by the slack.
struct HalfSpace {
  glm::dvec3 normal;
  double offset;
  bool contains(const glm::dvec3& point) const { return glm::dot(normal, point) <= offset; }
  /// The box corner farthest inside decides.
  bool touchesBox(const glm::dvec3& low, const glm::dvec3& high) const {
    double nearest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
      nearest += normal[axis] * (normal[axis] > 0.0 ? low[axis] : high[axis]);
    return nearest <= offset;
  }
};

/// Pyramid as six half-spaces (four sides, the base, and the apex's parallel to the base) and a box.
struct Shaft {
  std::array<HalfSpace, 6> halfSpaces;
  glm::dvec3 low, high;

  bool touchesBox(const glm::dvec3& boxLow, const glm::dvec3& boxHigh) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (boxHigh[axis] < low[axis] || boxLow[axis] > high[axis]) return false;
    }
    return std::all_of(halfSpaces.begin(), halfSpaces.end(),
                       [&](const HalfSpace& h) { return h.touchesBox(boxLow, boxHigh); });
  }
  bool touchesTriangle(const std::array<glm::dvec3, 3>& corners) const {
    return std::all_of(halfSpaces.begin(), halfSpaces.end(), [&](const HalfSpace& h) {
      return h.contains(corners[0]) || h.contains(corners[1]) || h.contains(corners[2]);
    });
  }
};

/// Fails where the apex is in the light's plane or the light has no area: there the sides have no direction.
bool makeShaft(const glm::dvec3& apex, const TraceLight& light, Shaft& shaft) {
  const glm::dvec3 toCenter = light.center - apex;
  // Some ten units in the last place of the distances involved.
  const double slack = 4e-15 * (4.0 + glm::length(apex) + glm::length(light.center) +
                                glm::length(light.halfU) + glm::length(light.halfV));
  const glm::dvec3 areaNormal = glm::cross(light.halfU, light.halfV);
  if (!(glm::length(areaNormal) > 0.0)) return false;
  glm::dvec3 normal = glm::normalize(areaNormal);
  if (glm::dot(normal, toCenter) < 0.0) normal = -normal;
  const double height = glm::dot(normal, toCenter);
  if (!(height > 1e-3 * glm::length(toCenter))) return false;
  shaft.halfSpaces[0] = {normal, glm::dot(normal, light.center) + slack};
  shaft.halfSpaces[1] = {-normal, -glm::dot(normal, apex) + slack};

  const std::array<glm::dvec3, 4> corners{
      toCenter - light.halfU - light.halfV, toCenter + light.halfU - light.halfV,
      toCenter + light.halfU + light.halfV, toCenter - light.halfU + light.halfV};
  shaft.low = shaft.high = apex;
  for (std::size_t i = 0; i < 4; ++i) {
    shaft.low = glm::min(shaft.low, apex + corners[i]);
    shaft.high = glm::max(shaft.high, apex + corners[i]);
    glm::dvec3 side = glm::cross(corners[i], corners[(i + 1) % 4]);
    if (!(glm::length(side) > 0.0)) return false;
    side = glm::normalize(side);
    if (glm::dot(side, toCenter) > 0.0) side = -side;
    shaft.halfSpaces[2 + i] = {side, glm::dot(side, apex) + slack};
  }
  shaft.low -= slack, shaft.high += slack;
  return true;
}

}  // namespace

CasterShafts::CasterShafts(const std::vector<TraceMesh>& casters) {
  for (const TraceMesh& mesh : casters) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      triangles_.push_back({{mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                             mesh.positions[mesh.indices[i + 2]]}});
    }
  }
  if (!triangles_.empty()) addNode(0, static_cast<std::uint32_t>(triangles_.size()));
}

std::uint32_t CasterShafts::addNode(std::uint32_t first, std::uint32_t count) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.low = node.high = triangles_[first].corners[0];
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const glm::dvec3& corner : triangles_[i].corners) {
      node.low = glm::min(node.low, corner), node.high = glm::max(node.high, corner);
    }
  }
  node.first = first;
  nodes_.push_back(node);
  if (count <= kTrianglesPerLeaf) {
    nodes_[index].count = count;
    return index;
  }
  const glm::dvec3 size = node.high - node.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t half = count / 2;
  const auto begin = triangles_.begin() + first;
  const auto doubledMiddle = [axis](const Triangle& t) {
    return std::min({t.corners[0][axis], t.corners[1][axis], t.corners[2][axis]}) +
           std::max({t.corners[0][axis], t.corners[1][axis], t.corners[2][axis]});
  };
  std::nth_element(begin, begin + half, begin + count,
                   [&](const Triangle& a, const Triangle& b) { return doubledMiddle(a) < doubledMiddle(b); });
  addNode(first, half);
  const std::uint32_t right = addNode(first + half, count - half);
  nodes_[index].right = right;
  return index;
}

bool CasterShafts::mayOcclude(const glm::dvec3& origin, const TraceLight& light) const {
  if (nodes_.empty()) return false;
  Shaft shaft;
  if (!makeShaft(origin, light, shaft)) return true;
  std::array<std::uint32_t, 64> pending;  // halving at every level: depth at most 32
  std::size_t pendingCount = 0;
  pending[pendingCount++] = 0;
  while (pendingCount > 0) {
    const std::uint32_t index = pending[--pendingCount];
    const Node& node = nodes_[index];
    if (!shaft.touchesBox(node.low, node.high)) continue;
    if (node.count == 0) {
      pending[pendingCount++] = node.right;
      pending[pendingCount++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (shaft.touchesTriangle(triangles_[i].corners)) return true;
    }
  }
  return false;
}

}  // namespace halfshadow::reference
