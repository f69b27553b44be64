// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/facet_tree_texels.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "techniques/parts/lists/list_codes.hpp"

namespace halfshadow::techniques {
namespace {
/// Codes of vertices from the centre: boxes are rounded outward by a step and 256.
constexpr float kReach = 32000.0f;
constexpr std::size_t kLeaf = 32768, kContour = 16384;
/// Tags of facet_tree.glsl.
constexpr int kStarts = 32, kEnds = 1;

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

/// Of a box and its facets, or of a box and what leads to its contour.
std::size_t nodeRecords(const outlines::FacetTree::Node& node) {
  return 1 + (node.isLeaf ? 3 * node.loopCount : hasContour(node) ? 1 : 0);
}

std::uint8_t boxCode(float steps) {
  return static_cast<std::uint8_t>(std::clamp(steps + 128.0f, 0.0f, 255.0f));
}

class TreeEncoder {
 public:
  TreeEncoder(const outlines::FacetTree& tree, std::uint8_t* texels) : tree_(tree), next_(texels) {
    const glm::vec3 low = tree.nodes.front().low, high = tree.nodes.front().high;
    placement_ = placementAbout(0.5f * (low + high), 0.5f * (high - low) / kReach);
  }

  void encode() {
    encodePlacement(placement_, take());
    std::vector<std::size_t> before(tree_.nodes.size() + 1, 0);
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n)
      before[n + 1] = before[n] + nodeRecords(tree_.nodes[n]);
    std::size_t contour = 2 + before.back();
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      const outlines::FacetTree::Node& node = tree_.nodes[n];
      putBox(node, before[node.end] - before[n]);
      if (node.isLeaf) putFacets(node);
      if (!hasContour(node)) continue;
      putNumber(contour, take());
      contour += contourRecords(tree_, node);
    }
    take();
    for (const outlines::FacetTree::Node& node : tree_.nodes) {
      if (hasContour(node)) putContour(node);
    }
  }

 private:
  /// The next record, blank.
  std::uint8_t* take() {
    std::uint8_t* const record = next_;
    next_ += kRecordBytes;
    return std::fill_n(record, kRecordBytes, std::uint8_t{0}), record;
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

  void putVertex(const glm::vec3& point, int tag) {
    std::uint8_t* const record = take();
    const glm::vec3 steps = (point - placement_.center) / placement_.step;
    for (int k = 0; k < 3; ++k) putCode(steps[k], record + 2 * k);
    record[6] = static_cast<std::uint8_t>(tag);
  }

  void putFacets(const outlines::FacetTree::Node& node) {
    for (std::uint32_t l = 0; l < node.loopCount; ++l) {
      for (std::uint32_t corner = 0; corner < 3; ++corner)
        putVertex(tree_.points[tree_.loops[node.firstLoop + l].first + corner],
                  corner == 2 && l + 1 == node.loopCount ? kEnds : 0);
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
  std::uint8_t* next_;
  ListPlacement placement_;
};
}  // namespace

std::size_t recordsOf(const outlines::FacetTree& tree) {
  std::size_t records = 2;
  for (const outlines::FacetTree::Node& node : tree.nodes)
    records += nodeRecords(node) + (hasContour(node) ? contourRecords(tree, node) : 0);
  return records;
}

void encodeTree(const outlines::FacetTree& tree, std::uint8_t* texels) {
  TreeEncoder(tree, texels).encode();
}

}  // namespace halfshadow::techniques
