// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/tree_calls.hpp"

#include <algorithm>

namespace halfshadow::outlines {
namespace {
/// Appends what leads into those trees that are in reach; whether some are.
bool appendTrees(const std::vector<FacetTree>& trees, std::uint8_t subLights, const TangentBox& receivers,
                 TileLists& lists, std::vector<ListRecord>& calls) {
  const std::size_t before = calls.size();
  const OuterSides outer(kWholeLight, receivers);
  for (const FacetTree& tree : trees) {
    const FacetTree::Node& all = tree.nodes.front();
    if (all.high.z <= receivers.iLow || outer.code(all.low, all.high) != 0) continue;
    const auto number = std::ranges::find(lists.trees, &tree) - lists.trees.begin();
    if (number == std::ssize(lists.trees)) lists.trees.push_back(&tree);
    calls.push_back(
        {.behindFacet = ListRecord::kTree, .tree = static_cast<std::uint32_t>(number), .treeFor = subLights});
  }
  if (calls.size() == before) return false;
  calls.back().end = ListRecord::End::caster;
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
  thread_local std::vector<ListRecord> records;
  records.clear();
  std::size_t found = 0;
  for (const TreeCall& call : calls) {
    if (call.subLights == 0) continue;
    const FacetTrees& trees = surfaces.treesOf(*call.surface);
    const bool some = appendTrees(trees.towards, call.subLights, receivers, lists, records);
    const std::size_t firstSide = records.size() - 1;
    const bool others = appendTrees(trees.away, call.subLights, receivers, lists, records);
    // The sides of a sheet cover the same ground.
    if (some && others) records[firstSide].firstSide = true;
    found += some || others;
  }
  lists.records.insert(lists.records.begin() + static_cast<std::ptrdiff_t>(first), records.begin(),
                       records.end());
  return found;
}

}  // namespace halfshadow::outlines
