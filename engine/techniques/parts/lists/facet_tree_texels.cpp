// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/facet_tree_texels.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "techniques/parts/lists/facet_strips.hpp"
#include "techniques/parts/lists/list_codes.hpp"

namespace halfshadow::techniques {
namespace {
/// Codes of vertices from the centre: boxes are rounded outward by a step and 256.
constexpr float kReach = 32000.0f;
constexpr std::size_t kLeaf = 32768, kContour = 16384;
/// Tags of facet_tree.glsl.
constexpr int kStarts = 32, kTurns = 2, kEnds = 1;

void putNumber(std::size_t number, std::uint8_t* bytes) {
  bytes[0] = static_cast<std::uint8_t>(number >> 8);
  bytes[1] = static_cast<std::uint8_t>(number & 255);
}

bool hasContour(const outlines::FacetTree::Node& node) {
  return !node.isLeaf && node.loopCount > 0;
}

/// Of a contour's loops, the first vertex of each once more.
std::size_t contourRecords(const outlines::FacetTree& tree, const outlines::FacetTree::Node& node) {
  std::size_t records = 0;
  for (std::uint32_t l = node.firstLoop; l < node.firstLoop + node.loopCount; ++l)
    records += tree.loops[l].count + 1;
  return records;
}

/// Byte 7 of a strip's vertex.
int facetCode(StripVertex::Facet facet) {
  switch (facet) {
    case StripVertex::Facet::none:
      return 1;
    case StripVertex::Facet::along:
      return 2;
    case StripVertex::Facet::against:
      return 0;
  }
  return 1;
}

std::uint8_t boxCode(float steps) {
  return static_cast<std::uint8_t>(std::clamp(steps + 128.0f, 0.0f, 255.0f));
}

class TreeEncoder {
 public:
  explicit TreeEncoder(const outlines::FacetTree& tree)
      : tree_(tree), firstStripVertex_(tree.nodes.size() + 1) {
    const glm::vec3 low = tree.nodes.front().low, high = tree.nodes.front().high;
    placement_ = placementAbout(0.5f * (low + high), 0.5f * (high - low) / kReach);
    FacetStrips strips;
    strips_.reserve(3 * tree.loops.size());
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      firstStripVertex_[n] = strips_.size();
      if (tree.nodes[n].isLeaf) strips.append(tree, tree.nodes[n], strips_);
    }
    firstStripVertex_.back() = strips_.size();
  }

  std::vector<std::uint8_t> encode() {
    std::vector<std::size_t> before(tree_.nodes.size() + 1, 0);
    std::size_t ofContours = 0;
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      before[n + 1] = before[n] + nodeRecords(n);
      if (hasContour(tree_.nodes[n])) ofContours += contourRecords(tree_, tree_.nodes[n]);
    }
    std::size_t contour = 2 + before.back();
    texels_.reserve((contour + ofContours) * kRecordBytes);
    encodePlacement(placement_, take());
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      const outlines::FacetTree::Node& node = tree_.nodes[n];
      putBox(node, before[node.end] - before[n]);
      if (node.isLeaf) putFacets(n);
      if (!hasContour(node)) continue;
      putNumber(contour, take());
      contour += contourRecords(tree_, node);
    }
    take();
    for (const outlines::FacetTree::Node& node : tree_.nodes) {
      if (hasContour(node)) putContour(node);
    }
    return std::move(texels_);
  }

 private:
  /// The next record, blank.
  std::uint8_t* take() {
    texels_.resize(texels_.size() + kRecordBytes);
    return texels_.data() + texels_.size() - kRecordBytes;
  }

  /// Of a box and its facets, or of a box and what leads to its contour.
  std::size_t nodeRecords(std::size_t node) const {
    return 1 + firstStripVertex_[node + 1] - firstStripVertex_[node] +
           (hasContour(tree_.nodes[node]) ? 1 : 0);
  }

  void putBox(const outlines::FacetTree::Node& node, std::size_t skip) {
    std::uint8_t* const record = take();
    for (int k = 0; k < 3; ++k) {
      const float wide = kCenterSteps * placement_.step[k], step = placement_.step[k];
      record[k] = boxCode(std::floor((node.low[k] - placement_.center[k] - step) / wide));
      record[3 + k] = boxCode(std::ceil((node.high[k] - placement_.center[k] + step) / wide));
    }
    putNumber(skip + (node.isLeaf ? kLeaf : hasContour(node) ? kContour : 0), record + 6);
  }

  std::uint8_t* putVertex(const glm::vec3& point, int tag) {
    std::uint8_t* const record = take();
    const glm::vec3 steps = (point - placement_.center) / placement_.step;
    for (int k = 0; k < 3; ++k) putCode(steps[k], record + 2 * k);
    record[6] = static_cast<std::uint8_t>(tag);
    return record;
  }

  void putFacets(std::size_t leaf) {
    const std::size_t end = firstStripVertex_[leaf + 1];
    for (std::size_t v = firstStripVertex_[leaf]; v < end; ++v) {
      const StripVertex& vertex = strips_[v];
      const int tag = (vertex.turns ? kTurns : 0) + (v + 1 == end ? kEnds : 0);
      putVertex(vertex.ti, tag)[7] = static_cast<std::uint8_t>(facetCode(vertex.facet));
    }
  }

  void putContour(const outlines::FacetTree::Node& node) {
    for (std::uint32_t l = 0; l < node.loopCount; ++l) {
      const outlines::FacetTree::Loop& loop = tree_.loops[node.firstLoop + l];
      for (std::uint32_t corner = 0; corner <= loop.count; ++corner) {
        const bool ends = corner == loop.count && l + 1 == node.loopCount;
        putVertex(tree_.points[loop.first + corner % loop.count], corner == 0 ? kStarts : ends ? kEnds : 0);
      }
    }
  }

  const outlines::FacetTree& tree_;
  ListPlacement placement_;
  std::vector<StripVertex> strips_;
  std::vector<std::size_t> firstStripVertex_;  ///< in `strips_`, by node, and after the last
  std::vector<std::uint8_t> texels_;
};
}  // namespace

std::vector<std::uint8_t> encodedTree(const outlines::FacetTree& tree) {
  return TreeEncoder(tree).encode();
}

}  // namespace halfshadow::techniques
