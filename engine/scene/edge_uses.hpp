// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Which faces use which edge (internal to engine/scene).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace halfshadow::scene {

struct EdgeUse {
  std::uint64_t key = 0;  ///< smaller vertex << 32 | larger vertex
  std::uint32_t face = 0;
  bool forward = true;  ///< from the smaller vertex to the larger
  std::uint32_t low() const { return static_cast<std::uint32_t>(key >> 32); }
  std::uint32_t high() const { return static_cast<std::uint32_t>(key); }
  std::uint32_t from() const { return forward ? low() : high(); }
  std::uint32_t to() const { return forward ? high() : low(); }
};

/// All uses, those of one edge side by side and in order of face.
std::vector<EdgeUse> edgeUses(std::span<const glm::uvec3> faces);

/// Calls visit(span of uses) for each edge.
template <class Visit>
void forEachEdge(std::span<const EdgeUse> uses, Visit&& visit) {
  for (std::size_t first = 0, last; first < uses.size(); first = last) {
    for (last = first + 1; last < uses.size() && uses[last].key == uses[first].key; ++last) {
    }
    visit(uses.subspan(first, last - first));
  }
}

/// Exactly two faces, in opposite directions.
bool isClean(std::span<const EdgeUse> edge);
/// Uses forward less uses backward.
int imbalance(std::span<const EdgeUse> edge);

/// Sets of elements that merge, with the smallest element as root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);
  std::uint32_t root(std::uint32_t i);
  void merge(std::uint32_t a, std::uint32_t b);
  /// One number per element, counted in order of first element; returns how many.
  std::uint32_t number(std::vector<std::uint32_t>& numberOf);

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace halfshadow::scene
