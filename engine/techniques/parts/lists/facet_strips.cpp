// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/facet_strips.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

namespace halfshadow::techniques {
namespace {
using Corners = std::span<const glm::vec3>;  // of a facet, three

/// How a facet goes on from the edge p q: the corner that it adds.
struct Step {
  bool found = false;
  std::size_t corner = 0;
  StripVertex::Facet facet = StripVertex::Facet::none;
};
Step stepOver(const glm::vec3& p, const glm::vec3& q, Corners facet) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec3 &a = facet[k], &b = facet[(k + 1) % 3];
    if (a == p && b == q) return {true, (k + 2) % 3, StripVertex::Facet::along};
    if (a == q && b == p) return {true, (k + 2) % 3, StripVertex::Facet::against};
  }
  return {};
}

bool contains(std::span<const std::uint32_t> numbers, std::uint32_t number) {
  return std::ranges::find(numbers, number) != numbers.end();
}

Corners cornersOf(const outlines::FacetTree& tree, std::uint32_t loop) {
  return std::span(tree.points).subspan(tree.loops[loop].first, 3);
}
}  // namespace

void FacetStrips::append(const outlines::FacetTree& tree, const outlines::FacetTree::Node& leaf,
                         std::vector<StripVertex>& vertices) {
  left_.resize(leaf.loopCount);
  std::iota(left_.begin(), left_.end(), leaf.firstLoop);
  while (!left_.empty()) {
    const Strip* best = nullptr;
    for (std::size_t rotation = 0; rotation < 3; ++rotation) {
      extend(tree, strips_[rotation], rotation);
      if (best == nullptr || strips_[rotation].loops.size() > best->loops.size()) best = &strips_[rotation];
    }
    vertices.insert(vertices.end(), best->vertices.begin(), best->vertices.end());
    std::erase_if(left_, [&](std::uint32_t loop) { return contains(best->loops, loop); });
  }
}

void FacetStrips::extend(const outlines::FacetTree& tree, Strip& strip, std::size_t rotation) const {
  const Corners start = cornersOf(tree, left_.front());
  std::array<glm::vec3, 3> last{start[rotation], start[(rotation + 1) % 3], start[(rotation + 2) % 3]};
  strip.vertices = {{.ti = last[0]}, {.ti = last[1]}, {.ti = last[2], .facet = StripVertex::Facet::along}};
  strip.loops = {left_.front()};
  const auto goesOn = [&](bool turns) {
    const glm::vec3 other = last[turns ? 0 : 1];
    for (const std::uint32_t loop : left_) {
      if (contains(strip.loops, loop)) continue;
      const Step step = stepOver(other, last[2], cornersOf(tree, loop));
      if (!step.found) continue;
      last = {other, last[2], cornersOf(tree, loop)[step.corner]};
      strip.vertices.push_back({.ti = last[2], .turns = turns, .facet = step.facet});
      strip.loops.push_back(loop);
      return true;
    }
    return false;
  };
  while (goesOn(false) || goesOn(true)) {
  }
}

}  // namespace halfshadow::techniques
