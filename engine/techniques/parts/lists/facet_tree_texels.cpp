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
/// Tags of list_vertices.glsl.
constexpr int kStarts = 32, kCloses = 16, kOneSided = 8, kEndsNode = 1;

void putNumber(std::size_t number, std::uint8_t* bytes) {
  bytes[0] = static_cast<std::uint8_t>(number >> 8);
  bytes[1] = static_cast<std::uint8_t>(number & 255);
}

/// Of a node's loops.
std::size_t loopRecords(const outlines::FacetTree& tree, const outlines::FacetTree::Node& node) {
  std::size_t records = 0;
  for (std::uint32_t l = node.firstLoop; l < node.firstLoop + node.loopCount; ++l)
    records += tree.loops[l].count + 1;
  return records;
}

bool hasContour(const outlines::FacetTree::Node& node) {
  return !node.isLeaf && node.loopCount > 0;
}

std::size_t nodeRecords(const outlines::FacetTree& tree, const outlines::FacetTree::Node& node) {
  return 1 + (hasContour(node) ? 1 : 0) + loopRecords(tree, node);
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
      before[n + 1] = before[n] + nodeRecords(tree_, tree_.nodes[n]);
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      const outlines::FacetTree::Node& node = tree_.nodes[n];
      putBox(node, before[node.end] - before[n]);
      if (hasContour(node)) putNumber(loopRecords(tree_, node), take());
      for (std::uint32_t l = node.firstLoop; l < node.firstLoop + node.loopCount; ++l)
        putLoop(tree_.loops[l], node.isLeaf, l + 1 == node.firstLoop + node.loopCount);
    }
    take();
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

  void putLoop(const outlines::FacetTree::Loop& loop, bool isFacet, bool isLast) {
    for (std::uint32_t corner = 0; corner <= loop.count; ++corner) {
      const bool closes = corner == loop.count;
      std::uint8_t* const record = take();
      const glm::vec3 point = tree_.points[loop.first + corner % loop.count];
      const glm::vec3 steps = (point - placement_.center) / placement_.step;
      for (int k = 0; k < 3; ++k) putCode(steps[k], record + 2 * k);
      record[6] = static_cast<std::uint8_t>((isFacet ? kOneSided : 0) | (corner == 0 ? kStarts : 0) |
                                            (closes ? kCloses : 0) | (closes && isLast ? kEndsNode : 0));
      record[7] = 1;
    }
  }

  const outlines::FacetTree& tree_;
  std::uint8_t* next_;
  ListPlacement placement_;
};
}  // namespace

std::size_t recordsOf(const outlines::FacetTree& tree) {
  std::size_t records = 2;
  for (const outlines::FacetTree::Node& node : tree.nodes) records += nodeRecords(tree, node);
  return records;
}

void encodeTree(const outlines::FacetTree& tree, std::uint8_t* texels) {
  TreeEncoder(tree, texels).encode();
}

}  // namespace halfshadow::techniques
