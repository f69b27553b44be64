// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/facet_tree.hpp"

#include <algorithm>
#include <span>

#include "outlines/facet_sides.hpp"

namespace halfshadow::outlines {
namespace {
/// Facets of a leaf: with eight a fragment fetches a fiftieth more, with fourteen a tenth.
constexpr std::size_t kLeafFacets = 4;
/// Facets from which on a box may have a contour, and how many times fewer vertices that must have.
constexpr std::size_t kContourFacets = 6;
constexpr std::size_t kContourShare = 2;
/// Vertices of a tree's contours, and one more for each loop: with its facets and boxes what leads over all
/// of it still fits 14 bits in records.
constexpr std::size_t kMostContourVertices = 8192;

enum class LightSide { outer, inner };

class TreeBuilder {
 public:
  /// `sides`: of each facet, where the light lies, as facetSide() tells.
  TreeBuilder(const NearSurface& surface, std::span<const int> sides, LightSide lightSide)
      : surface_(surface), sides_(sides), lightSide_(lightSide), memberOf_(surface.facets.size(), 0) {
    nextEdge_.resize(surface.points.size());
    middles_.reserve(surface.facets.size());
    for (const NearSurface::Facet& facet : surface.facets) middles_.push_back(facet.low + facet.high);
  }

  std::vector<FacetTree> build() {
    std::vector<std::uint32_t> facets;
    for (std::uint32_t f = 0; f < surface_.facets.size(); ++f) {
      if (lightSide_ == LightSide::outer ? sides_[f] >= 0 : sides_[f] <= 0) facets.push_back(f);
    }
    if (!facets.empty()) divide(facets);
    return std::move(trees_);
  }

 private:
  /// Halves along the longest side of where the facets' middles are.
  std::size_t split(std::span<std::uint32_t> facets) const {
    glm::vec3 low(1e30f), high(-1e30f);
    for (const std::uint32_t f : facets) {
      low = glm::min(low, middles_[f]);
      high = glm::max(high, middles_[f]);
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    const std::size_t half = facets.size() / 2;
    std::ranges::nth_element(facets, facets.begin() + static_cast<std::ptrdiff_t>(half), {},
                             [&](std::uint32_t f) { return middles_[f][axis]; });
    return half;
  }

  void divide(std::span<std::uint32_t> facets) {
    if (facets.size() > kMostTreeFacets) {
      const std::size_t half = split(facets);
      divide(facets.first(half));
      divide(facets.subspan(half));
      return;
    }
    contourVertices_ = 0;
    addNode(facets, trees_.emplace_back());
  }

  void addNode(std::span<std::uint32_t> facets, FacetTree& tree) {
    const std::size_t number = tree.nodes.size();
    FacetTree::Node node{.low = glm::vec3(1e30f),
                         .high = glm::vec3(-1e30f),
                         .firstLoop = static_cast<std::uint32_t>(tree.loops.size()),
                         .isLeaf = facets.size() <= kLeafFacets};
    for (const std::uint32_t f : facets) {
      node.low = glm::min(node.low, surface_.facets[f].low);
      node.high = glm::max(node.high, surface_.facets[f].high);
    }
    if (node.isLeaf) {
      for (const std::uint32_t f : facets) addLoop(surface_.facets[f].vertex, tree);
    } else {
      addContour(facets, tree);
    }
    node.loopCount = static_cast<std::uint32_t>(tree.loops.size()) - node.firstLoop;
    tree.nodes.push_back(node);
    if (!node.isLeaf) {
      const std::size_t half = split(facets);
      addNode(facets.first(half), tree);
      addNode(facets.subspan(half), tree);
    }
    tree.nodes[number].end = static_cast<std::uint32_t>(tree.nodes.size());
  }

  /// `vertices` run as those of NearSurface::Facet.
  void addLoop(std::span<const std::uint32_t> vertices, FacetTree& tree) const {
    tree.loops.push_back(
        {static_cast<std::uint32_t>(tree.points.size()), static_cast<std::uint32_t>(vertices.size())});
    for (const std::uint32_t v : vertices) tree.points.push_back(surface_.points[v]);
    if (lightSide_ == LightSide::inner)
      std::reverse(tree.points.end() - std::ptrdiff_t(vertices.size()), tree.points.end());
  }

  void addContour(std::span<const std::uint32_t> facets, FacetTree& tree) {
    if (facets.size() < kContourFacets) return;
    if (std::ranges::any_of(facets, [&](std::uint32_t f) { return sides_[f] == 0; })) return;
    ++set_;
    for (const std::uint32_t f : facets) memberOf_[f] = set_;
    edges_.clear();
    for (const std::uint32_t f : facets) {
      const NearSurface::Facet& facet = surface_.facets[f];
      for (std::size_t k = 0; k < 3; ++k) {
        if (facet.beyond[k] != kNoFacet && memberOf_[facet.beyond[k]] == set_) continue;
        edges_.push_back({facet.vertex[k], facet.vertex[(k + 1) % 3]});
      }
    }
    const std::size_t edges = edges_.size();
    // A loop has three edges or more.
    const std::size_t most = edges + edges / 3;
    if (edges * kContourShare > 3 * facets.size() || contourVertices_ + most > kMostContourVertices) return;
    contourVertices_ += most;
    addBoundary(tree);
  }

  /// As many edges enter a vertex as leave it: a walk ends where it began.
  void addBoundary(FacetTree& tree) {
    std::ranges::stable_sort(edges_, {}, &Edge::from);
    // Of each vertex that edges leave, the next of them that no loop has.
    for (std::size_t e = edges_.size(); e-- > 0;) nextEdge_[edges_[e].from] = static_cast<std::uint32_t>(e);
    const auto isLeft = [&](std::uint32_t v) {
      return nextEdge_[v] < edges_.size() && edges_[nextEdge_[v]].from == v;
    };
    std::vector<std::uint32_t>& loop = loop_;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const std::uint32_t start = edges_[e].from;
      if (nextEdge_[start] > e) continue;
      loop.clear();
      std::uint32_t at = start;
      do {
        if (!isLeft(at)) break;
        loop.push_back(at);
        at = edges_[nextEdge_[at]++].to;
      } while (at != start);
      if (loop.size() > 2) addLoop(loop, tree);
    }
  }

  struct Edge {
    std::uint32_t from = 0, to = 0;
  };
  const NearSurface& surface_;
  std::span<const int> sides_;
  LightSide lightSide_;
  std::vector<glm::vec3> middles_;       ///< of facets' boxes, doubled
  std::vector<std::uint32_t> memberOf_;  ///< of each facet, the last set that had it
  std::uint32_t set_ = 0;
  std::size_t contourVertices_ = 0;      ///< of the tree that is being made
  std::vector<Edge> edges_;              ///< on the boundary of a set
  std::vector<std::uint32_t> nextEdge_;  ///< in `edges_`, by point
  std::vector<std::uint32_t> loop_;
  std::vector<FacetTree> trees_;
};
}  // namespace

FacetTrees facetTrees(const NearSurface& surface) {
  std::vector<int> sides;
  sides.reserve(surface.facets.size());
  for (const NearSurface::Facet& facet : surface.facets) sides.push_back(lightSideOf(facet, kWholeLight));
  FacetTrees trees{.towards = TreeBuilder(surface, sides, LightSide::outer).build()};
  if (!surface.closed) trees.away = TreeBuilder(surface, sides, LightSide::inner).build();
  return trees;
}

}  // namespace halfshadow::outlines
