// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scene/edge_uses.hpp"

#include <algorithm>
#include <numeric>

namespace halfshadow::scene {

std::vector<EdgeUse> edgeUses(std::span<const glm::uvec3> faces) {
  std::uint32_t last = 0;
  for (const glm::uvec3& face : faces) last = std::max({last, face.x, face.y, face.z});
  const auto forEachUse = [&](const auto& visit) {
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const std::uint64_t a = faces[f][k], b = faces[f][(k + 1) % 3];
        visit(EdgeUse{a < b ? a << 32 | b : b << 32 | a, f, a < b});
      }
    }
  };
  const auto inOrder = [](const EdgeUse& a, const EdgeUse& b) {
    return a.key != b.key ? a.key < b.key : a.face < b.face;
  };
  // A small part of a mesh must not cost what all its vertices do.
  constexpr std::size_t kVerticesPerFace = 4;
  if (last > kVerticesPerFace * faces.size()) {
    std::vector<EdgeUse> uses;
    uses.reserve(faces.size() * 3);
    forEachUse([&](const EdgeUse& use) { uses.push_back(use); });
    std::sort(uses.begin(), uses.end(), inOrder);
    return uses;
  }
  // Counted by the lesser end first: what is left to sort are the few edges of one vertex.
  std::vector<std::size_t> begins(faces.empty() ? 1 : std::size_t{last} + 2, 0);
  const auto lesserEnd = [](const EdgeUse& use) { return static_cast<std::size_t>(use.key >> 32); };
  forEachUse([&](const EdgeUse& use) { ++begins[lesserEnd(use) + 1]; });
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<EdgeUse> uses(faces.size() * 3);
  std::vector<std::size_t> next = begins;
  forEachUse([&](const EdgeUse& use) { uses[next[lesserEnd(use)]++] = use; });
  for (std::size_t vertex = 0; vertex + 1 < begins.size(); ++vertex) {
    std::sort(uses.begin() + static_cast<std::ptrdiff_t>(begins[vertex]),
              uses.begin() + static_cast<std::ptrdiff_t>(begins[vertex + 1]), inOrder);
  }
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
