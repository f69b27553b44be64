// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/triangle_tree.hpp"

#include <algorithm>

namespace halfshadow::scenes {
namespace {
constexpr std::uint32_t kPerLeaf = 8;
/// A ray that ends at a surface does not meet it.
constexpr double kBeforeEnd = 1.0 - 1e-6;

/// Share of the way at which the triangle is met; infinite where it is not.
double shareAt(const WorldTriangle& triangle, const glm::dvec3& start, const glm::dvec3& way) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const glm::dvec3 ab = triangle.corners[1] - triangle.corners[0],
                   ac = triangle.corners[2] - triangle.corners[0];
  const glm::dvec3 p = glm::cross(way, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return kNone;
  const glm::dvec3 toStart = start - triangle.corners[0];
  const double u = glm::dot(toStart, p) / determinant;
  const glm::dvec3 q = glm::cross(toStart, ab);
  const double v = glm::dot(way, q) / determinant, share = glm::dot(ac, q) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && share > 0.0 ? share : kNone;
}

/// Whether the box is met before `share` of the way. 0 · infinity is no bound: such an axis never excludes.
bool meetsBox(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& start,
              const glm::dvec3& inverse, double share) {
  double enters = 0.0, leaves = share;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - start[axis]) * inverse[axis],
                 b = (high[axis] - start[axis]) * inverse[axis];
    if (std::min(a, b) > enters) enters = std::min(a, b);
    if (std::max(a, b) < leaves) leaves = std::max(a, b);
  }
  return enters <= leaves;
}
}  // namespace

TriangleTree::TriangleTree(const scene::SceneDescription& description) {
  std::size_t count = 0;
  for (const scene::SceneObject& object : description.objects) count += object.mesh->triangleCount();
  triangles_.reserve(count);
  for (std::uint32_t o = 0; o < description.objects.size(); ++o) {
    const scene::SceneObject& object = description.objects[o];
    const scene::TriangleMesh& mesh = *object.mesh;
    std::vector<glm::dvec3> world;
    world.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions)
      world.emplace_back(object.worldFromObject * glm::dvec4(glm::dvec3(position), 1.0));
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      WorldTriangle triangle{.object = o, .shell = mesh.shellOf.empty() ? scene::kNoShell : mesh.shellOf[t]};
      for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = world[mesh.indices[3 * t + k]];
      triangles_.push_back(triangle);
    }
  }
}

std::uint32_t TriangleTree::addNode(std::uint32_t first, std::uint32_t count) const {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({.first = first, .count = count});
  scene::Bounds box, middles;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const glm::dvec3& corner : triangles_[i].corners) box.include(corner);
    middles.include(triangles_[i].corners[0] + triangles_[i].corners[1] + triangles_[i].corners[2]);
  }
  nodes_[index].low = box.low, nodes_[index].high = box.high;
  if (count <= kPerLeaf) return index;
  const glm::dvec3 size = middles.high - middles.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [axis](const auto& a, const auto& b) {
    return a.corners[0][axis] + a.corners[1][axis] + a.corners[2][axis] <
           b.corners[0][axis] + b.corners[1][axis] + b.corners[2][axis];
  });
  addNode(first, count / 2);
  nodes_[index].right = addNode(first + count / 2, count - count / 2);
  nodes_[index].count = 0;
  return index;
}

TriangleTree::Hit TriangleTree::firstOn(const glm::dvec3& start, const glm::dvec3& way,
                                        const WorldTriangle* own) const {
  Hit hit;
  if (triangles_.empty()) return hit;
  order();
  double nearest = 1.0;
  const glm::dvec3 inverse = 1.0 / way;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t index = open.back();
    const Node& node = nodes_[index];
    open.pop_back();
    if (!meetsBox(node.low, node.high, start, inverse, nearest)) continue;
    if (node.count == 0) {
      open.insert(open.end(), {node.right, index + 1});
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const double share = shareAt(triangles_[i], start, way);
      if (share >= nearest || &triangles_[i] == own) continue;
      nearest = share;
      hit = {share, &triangles_[i]};
    }
  }
  return hit;
}

bool TriangleTree::isBetween(const glm::dvec3& start, const glm::dvec3& end, const WorldTriangle* own) const {
  return firstOn(start, (end - start) * kBeforeEnd, own).triangle != nullptr;
}

}  // namespace halfshadow::scenes
