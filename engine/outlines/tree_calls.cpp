// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/tree_calls.hpp"

#include <algorithm>

namespace halfshadow::outlines {
namespace {
/// Appends what leads into those trees that are in reach; whether some are.
bool appendTrees(const std::vector<FacetTree>& trees, std::uint8_t subLights, const TangentBox& receivers,
                 TileLists& lists) {
  const std::size_t before = lists.records.size();
  const OuterSides outer(kWholeLight, receivers);
  for (const FacetTree& tree : trees) {
    const FacetTree::Node& all = tree.nodes.front();
    if (all.high.z <= receivers.iLow || outer.code(all.low, all.high) != 0) continue;
    const auto number = std::ranges::find(lists.trees, &tree) - lists.trees.begin();
    if (number == std::ssize(lists.trees)) lists.trees.push_back(&tree);
    lists.records.push_back(
        {.behindFacet = ListRecord::kTree, .tree = static_cast<std::uint32_t>(number), .treeFor = subLights});
  }
  if (lists.records.size() == before) return false;
  lists.records.back().end = ListRecord::End::caster;
  return true;
}

}  // namespace

void callTrees(const NearSurface& surface, std::uint8_t subLights, std::vector<TreeCall>& calls) {
  const auto call = std::ranges::find(calls, &surface, &TreeCall::surface);
  if (call == calls.end())
    calls.push_back({&surface, subLights});
  else
    call->subLights |= subLights;
}

std::size_t insertTrees(const std::vector<TreeCall>& calls, const TangentBox& receivers, std::size_t first,
                        NearSurfaces& surfaces, TileLists& lists) {
  std::vector<ListRecord>& records = lists.records;
  const std::size_t before = records.size();
  std::size_t found = 0;
  for (const TreeCall& call : calls) {
    if (call.subLights == 0) continue;
    const FacetTrees& trees = surfaces.treesOf(*call.surface);
    const bool some = appendTrees(trees.towards, call.subLights, receivers, lists);
    const std::size_t firstSide = records.size() - 1;
    const bool others = appendTrees(trees.away, call.subLights, receivers, lists);
    // The sides of a sheet cover the same ground.
    if (some && others) records[firstSide].firstSide = true;
    found += some || others;
  }
  const auto at = [&](std::size_t n) { return records.begin() + static_cast<std::ptrdiff_t>(n); };
  std::rotate(at(first), at(before), records.end());
  return found;
}

}  // namespace halfshadow::outlines
