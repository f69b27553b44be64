// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/edge_uses.hpp"

#include <algorithm>
#include <numeric>

namespace halfshadow::scene {

std::vector<EdgeUse> edgeUses(std::span<const glm::uvec3> faces) {
  std::vector<EdgeUse> uses;
  uses.reserve(faces.size() * 3);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = faces[f][k], b = faces[f][(k + 1) % 3];
      uses.push_back({a < b ? a << 32 | b : b << 32 | a, f, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return a.key != b.key ? a.key < b.key : a.face < b.face;
  });
  return uses;
}

bool isClean(std::span<const EdgeUse> edge) {
  return edge.size() == 2 && edge[0].forward != edge[1].forward;
}

int imbalance(std::span<const EdgeUse> edge) {
  int sum = 0;
  for (const EdgeUse& use : edge) sum += use.forward ? 1 : -1;
  return sum;
}

DisjointSets::DisjointSets(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0u);
}

std::uint32_t DisjointSets::root(std::uint32_t i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

void DisjointSets::merge(std::uint32_t a, std::uint32_t b) {
  a = root(a);
  b = root(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

std::uint32_t DisjointSets::number(std::vector<std::uint32_t>& numberOf) {
  numberOf.resize(parent_.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < parent_.size(); ++i) {
    const std::uint32_t first = root(i);
    numberOf[i] = first == i ? count++ : numberOf[first];
  }
  return count;
}

}  // namespace halfshadow::scene
