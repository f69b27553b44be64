// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/border_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

#include "scene/bounds.hpp"
#include "scene/edge_uses.hpp"

namespace halfshadow::scene {
namespace {
std::vector<glm::uvec3> cornersOf(const std::vector<SoupFace>& faces) {
  std::vector<glm::uvec3> corners(faces.size());
  std::transform(faces.begin(), faces.end(), corners.begin(), [](const SoupFace& f) { return f.corners; });
  return corners;
}

/// Edges that only one face uses.
std::vector<EdgeUse> openEdges(std::span<const glm::uvec3> faces) {
  std::vector<EdgeUse> open;
  forEachEdge(edgeUses(faces), [&](std::span<const EdgeUse> edge) {
    if (edge.size() == 1) open.push_back(edge[0]);
  });
  return open;
}

std::vector<std::uint32_t> verticesOf(const std::vector<EdgeUse>& edges) {
  std::vector<std::uint32_t> vertices;
  for (const EdgeUse& edge : edges) vertices.insert(vertices.end(), {edge.low(), edge.high()});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Length below which float positions of this mesh say nothing.
double roundingOf(std::span<const glm::vec3> positions, std::span<const std::uint32_t> vertices) {
  double largest = 0.0;
  for (const std::uint32_t v : vertices) {
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(static_cast<double>(positions[v][k])));
  }
  return 2.0 * std::numeric_limits<float>::epsilon() * largest;
}

/// Vertices sorted along the axis in which they spread most.
class SortedVertices {
 public:
  SortedVertices(std::vector<std::uint32_t> vertices, std::span<const glm::vec3> positions)
      : vertices_(std::move(vertices)), positions_(positions) {
    Bounds bounds;
    for (const std::uint32_t v : vertices_) bounds.include(glm::dvec3(positions[v]));
    const glm::dvec3 size = bounds.high - bounds.low;
    axis_ = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    std::sort(vertices_.begin(), vertices_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  }
  /// Those that may lie in the box around a and b, widened.
  std::span<const std::uint32_t> near(const glm::vec3& a, const glm::vec3& b, double reach) const {
    const double low = std::min(a[axis_], b[axis_]) - reach, high = std::max(a[axis_], b[axis_]) + reach;
    const auto first = std::lower_bound(vertices_.begin(), vertices_.end(), low,
                                        [&](std::uint32_t v, double at) { return place(v) < at; });
    const auto last = std::upper_bound(first, vertices_.end(), high,
                                       [&](double at, std::uint32_t v) { return at < place(v); });
    return {first, last};
  }

 private:
  double place(std::uint32_t v) const { return positions_[v][axis_]; }
  std::vector<std::uint32_t> vertices_;
  std::span<const glm::vec3> positions_;
  int axis_ = 0;
};

/// Open edges of a mesh, with what is needed to find vertices on them.
class OpenBorder {
 public:
  OpenBorder(std::span<const glm::uvec3> faces, std::span<const glm::vec3> positions)
      : edges(openEdges(faces)),
        positions_(positions),
        sorted_(verticesOf(edges), positions),
        rounding_(roundingOf(positions, verticesOf(edges))) {
    for (const EdgeUse& edge : edges) {
      neighbours_.emplace(edge.low(), edge.high());
      neighbours_.emplace(edge.high(), edge.low());
    }
  }

  /// The vertex nearest to the middle of those that lie inside the edge and from which another open edge
  /// leaves along it; kNone without one.
  std::uint32_t vertexOn(const EdgeUse& edge) const {
    const glm::dvec3 a(positions_[edge.low()]), b(positions_[edge.high()]);
    // 1e-4 of the edge's length: what exporters that round to four or five digits leave.
    const double reach = 1e-4 * glm::length(b - a) + rounding_;
    std::uint32_t best = kNone;
    double bestDistance = 0.5;
    for (const std::uint32_t v : sorted_.near(positions_[edge.low()], positions_[edge.high()], reach)) {
      if (v == edge.low() || v == edge.high()) continue;
      const double t = along(v, a, b, reach);
      if (t < 0.0 || std::abs(t - 0.5) >= bestDistance || !continues(v, edge, a, b, reach)) continue;
      best = v;
      bestDistance = std::abs(t - 0.5);
    }
    return best;
  }

  static constexpr std::uint32_t kNone = ~0u;
  std::vector<EdgeUse> edges;

 private:
  /// Where on a-b the vertex lies, in (0, 1); negative when it does not.
  double along(std::uint32_t v, const glm::dvec3& a, const glm::dvec3& b, double reach) const {
    const glm::dvec3 d = b - a, p = glm::dvec3(positions_[v]) - a;
    const double length = glm::length(d), t = glm::dot(p, d) / (length * length);
    if (!(t * length > reach) || !((1.0 - t) * length > reach)) return -1.0;
    return glm::length(p - t * d) <= reach ? t : -1.0;
  }
  bool continues(std::uint32_t v, const EdgeUse& edge, const glm::dvec3& a, const glm::dvec3& b,
                 double reach) const {
    const auto [first, last] = neighbours_.equal_range(v);
    return std::any_of(first, last, [&](const auto& pair) {
      const std::uint32_t next = pair.second;
      return next == edge.low() || next == edge.high() || along(next, a, b, reach) >= 0.0;
    });
  }

  std::span<const glm::vec3> positions_;
  SortedVertices sorted_;
  double rounding_;
  std::unordered_multimap<std::uint32_t, std::uint32_t> neighbours_;
};
}  // namespace

std::uint32_t mergeNearBorderVertices(std::vector<SoupFace>& faces, std::span<const glm::vec3> positions) {
  const std::vector<std::uint32_t> vertices = verticesOf(openEdges(cornersOf(faces)));
  Bounds bounds;
  for (const SoupFace& face : faces) {
    for (int k = 0; k < 3; ++k) bounds.include(glm::dvec3(positions[face.corners[k]]));
  }
  const double reach = std::max(1e-6 * bounds.radius(), roundingOf(positions, vertices));
  const SortedVertices sorted(vertices, positions);
  std::unordered_map<std::uint32_t, std::uint32_t> merged;
  for (const std::uint32_t v : vertices) {
    if (merged.contains(v)) continue;
    for (const std::uint32_t other : sorted.near(positions[v], positions[v], reach)) {
      if (other <= v || merged.contains(other)) continue;
      if (glm::length(glm::dvec3(positions[other]) - glm::dvec3(positions[v])) <= reach) merged[other] = v;
    }
  }
  if (merged.empty()) return 0;
  for (SoupFace& face : faces) {
    for (int k = 0; k < 3; ++k) {
      const auto found = merged.find(face.corners[k]);
      if (found != merged.end()) face.corners[k] = found->second;
    }
  }
  std::erase_if(faces, [](const SoupFace& face) {
    const glm::uvec3& c = face.corners;
    return c.x == c.y || c.y == c.z || c.z == c.x;
  });
  return static_cast<std::uint32_t>(merged.size());
}

void splitTJunctions(std::vector<SoupFace>& faces, std::span<const glm::vec3> positions) {
  // Each pass halves the vertices on an edge, so that 32 passes are enough for any number of them.
  for (int pass = 0; pass < 32; ++pass) {
    const OpenBorder border(cornersOf(faces), positions);
    std::vector<bool> done(faces.size(), false);
    bool found = false;
    for (const EdgeUse& edge : border.edges) {
      if (done[edge.face]) continue;
      const std::uint32_t v = border.vertexOn(edge);
      if (v == OpenBorder::kNone) continue;
      glm::uvec3& own = faces[edge.face].corners;
      if (own.x == v || own.y == v || own.z == v) continue;
      glm::uvec3 rest = own;
      for (int k = 0; k < 3; ++k) {
        if (own[k] == edge.to()) own[k] = v;
        if (rest[k] == edge.from()) rest[k] = v;
      }
      faces.push_back({rest, true});
      done[edge.face] = found = true;
    }
    if (!found) return;
  }
}

std::vector<BorderLoop> borderLoops(std::span<const glm::uvec3> faces) {
  std::unordered_multimap<std::uint32_t, std::uint32_t> next;
  std::vector<EdgeUse> edges = openEdges(faces);
  for (const EdgeUse& edge : edges) next.emplace(edge.from(), edge.to());
  std::vector<BorderLoop> loops;
  for (const EdgeUse& edge : edges) {
    BorderLoop loop;
    std::unordered_map<std::uint32_t, std::size_t> placeOf;
    // Walks until a vertex comes again; the loop is what lies between.
    std::uint32_t at = edge.from();
    while (true) {
      const auto seen = placeOf.find(at);
      if (seen != placeOf.end()) {
        const auto first = loop.begin() + static_cast<std::ptrdiff_t>(seen->second);
        loops.emplace_back(first, loop.end());
        for (auto v = first; v != loop.end(); ++v) placeOf.erase(*v);
        loop.erase(first, loop.end());
      }
      const auto onward = next.find(at);
      if (onward == next.end()) break;
      placeOf[at] = loop.size();
      loop.push_back(at);
      at = onward->second;
      next.erase(onward);
    }
  }
  return loops;
}

Filling fillLoop(const BorderLoop& loop, std::span<const glm::vec3> positions) {
  const std::size_t n = loop.size();
  const auto point = [&](std::size_t i) { return glm::dvec3(positions[loop[i % n]]); };
  Filling filling;
  std::size_t sharpest = 0;
  double sharpestTurn = 2.0;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3 before = point(i) - point(i + n - 1), after = point(i + 1) - point(i);
    filling.perimeter += glm::length(after);
    const double turn = glm::dot(before, after) / std::max(glm::length(before) * glm::length(after), 1e-300);
    if (turn < sharpestTurn) sharpest = i, sharpestTurn = turn;
  }
  // Two fingers walk away from the sharpest corner, always along the shorter cross-link.
  std::size_t left = sharpest + n - 1, right = sharpest + 1, tip = sharpest;
  const auto addFace = [&](std::size_t a, std::size_t b, std::size_t c) {
    filling.faces.push_back({loop[c % n], loop[b % n], loop[a % n]});
    filling.area += 0.5 * glm::length(glm::cross(point(b) - point(a), point(c) - point(a)));
  };
  addFace(left, tip, right);
  while (left - right > 1) {
    if (glm::length(point(left - 1) - point(right)) < glm::length(point(left) - point(right + 1))) {
      addFace(left - 1, left, right);
      --left;
    } else {
      addFace(left, right, right + 1);
      ++right;
    }
  }
  return filling;
}

}  // namespace halfshadow::scene
