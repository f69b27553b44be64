// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/cut_silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace halfshadow::scene {
namespace {
/// A vertex as (v, v), or where the plane cuts the edge (smaller, larger).
using Node = std::uint64_t;

Node vertexNode(std::uint32_t v) {
  return std::uint64_t{v} << 32 | v;
}

Node cutNode(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

class Cut {
 public:
  Cut(const HalfEdgeMesh& mesh, const AffineMap& map, double minHeight)
      : mesh_(mesh), map_(map), minHeight_(minHeight) {}

  void addEdge(std::uint32_t from, std::uint32_t to) {
    const bool fromIn = inside(from), toIn = inside(to);
    if (!fromIn && !toIn) return;
    link(fromIn ? vertexNode(from) : cutNode(from, to), toIn ? vertexNode(to) : cutNode(from, to));
  }

  /// The line across a face, in the direction of the boundary of its part inside.
  void addFace(const glm::uvec3& face, bool turned) {
    Node leave = 0, enter = 0;
    int crossings = 0;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % 3];
      const bool aIn = inside(a), bIn = inside(b);
      if (aIn == bIn) continue;
      (aIn ? leave : enter) = cutNode(a, b);
      ++crossings;
    }
    if (crossings != 2) return;
    if (turned) {
      link(enter, leave);
    } else {
      link(leave, enter);
    }
  }

  /// Every node is left as often as it is reached, so that each walk ends where it began.
  void chain(std::vector<std::vector<glm::dvec3>>& loops) {
    for (const Node start : starts_) {
      for (auto next = links_.find(start); next != links_.end(); next = links_.find(start)) {
        std::vector<glm::dvec3> loop;
        while (next != links_.end()) {
          loop.push_back(place(next->first));
          const Node to = next->second;
          links_.erase(next);
          next = to == start ? links_.end() : links_.find(to);
        }
        if (loop.size() > 2) loops.push_back(std::move(loop));
      }
    }
  }

 private:
  bool inside(std::uint32_t v) const { return map_(mesh_.positions()[v]).z >= minHeight_; }

  glm::dvec3 place(Node node) const {
    const auto a = static_cast<std::uint32_t>(node >> 32), b = static_cast<std::uint32_t>(node);
    const glm::dvec3 p = map_(mesh_.positions()[a]);
    if (a == b) return p;
    const glm::dvec3 q = map_(mesh_.positions()[b]);
    return glm::mix(p, q, (minHeight_ - p.z) / (q.z - p.z));
  }

  void link(Node from, Node to) {
    links_.emplace(from, to);
    starts_.push_back(from);
  }

  const HalfEdgeMesh& mesh_;
  const AffineMap& map_;
  double minHeight_;
  std::unordered_multimap<Node, Node> links_;
  std::vector<Node> starts_;
};
}  // namespace

HeightRange heightRange(const Bounds& bounds, const AffineMap& map, double minHeight) {
  const glm::dvec3 row(map.linear[0].z, map.linear[1].z, map.linear[2].z);
  const double center = glm::dot(row, bounds.center()) + map.offset.z;
  const double reach = glm::dot(glm::abs(row), (bounds.high - bounds.low) * 0.5);
  // Rounding of what is summed up, so that no vertex is on the other side.
  const double rounding = 1e-12 * (std::abs(map.offset.z) + glm::dot(glm::abs(row), glm::abs(bounds.high)));
  if (center - reach - rounding >= minHeight) return HeightRange::above;
  return center + reach + rounding < minHeight ? HeightRange::below : HeightRange::through;
}

void cutSilhouette(const HalfEdgeMesh& mesh, const Silhouette& silhouette, const Silhouette::Part& entry,
                   const AffineMap& map, double minHeight, std::vector<std::vector<glm::dvec3>>& loops) {
  Cut cut(mesh, map, minHeight);
  for (std::uint32_t l = entry.firstLoop; l < entry.firstLoop + entry.loopCount; ++l) {
    const Silhouette::Loop& loop = silhouette.loops[l];
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      cut.addEdge(silhouette.vertices[loop.first + i],
                  silhouette.vertices[loop.first + (i + 1) % loop.count]);
    }
  }
  const CasterPart& part = mesh.parts()[entry.part];
  for (std::uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
    if (entry.region != kNoFace && silhouette.regions[f] != entry.region) continue;
    if ((silhouette.facing[f] == 0) == entry.turnedAway) cut.addFace(mesh.faces()[f], entry.turnedAway);
  }
  cut.chain(loops);
}

}  // namespace halfshadow::scene
