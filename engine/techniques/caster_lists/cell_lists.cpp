// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/caster_lists/cell_lists.hpp"

#include <algorithm>

namespace halfshadow::techniques {
namespace {
/// Tiles along a side of a block: casters are simplified for the block first, so that its tiles start from
/// few vertices.
constexpr int kBlock = 8;

/// What may shadow a block, per sub-light.
struct BlockCasters {
  std::vector<CasterLoops> partial;
  bool full = false;
};

/// Appends what the fragments walk. Where all receivers lie behind the whole caster, edges that cover nothing
/// are left out; elsewhere fragments cut loops at their own height and need them whole.
void appendCaster(const CasterLoops& caster, const SubLight& light, const TangentBox& receivers,
                  std::uint8_t subLight, ListedEdges edges, std::vector<CellRecord>& records) {
  const std::size_t before = records.size();
  const bool whole = edges == ListedEdges::all || caster.low.z < receivers.iHigh;
  const OuterSides sides(light, receivers);
  for (const CasterLoops::Loop& loop : caster.loops) {
    const auto at = [&](std::uint32_t k) { return caster.points[loop.first + k % loop.count]; };
    bool chained = false;
    for (std::uint32_t k = 0; k <= loop.count; ++k) {
      const bool leads = k < loop.count &&
                         (whole || !(sides.code(at(k)) & sides.code(at(k + 1)) & OuterSides::kCoversNothing));
      if (chained || leads) {
        records.push_back({.ti = at(k),
                           .subLight = subLight,
                           .startsLoop = !chained,
                           .closesLoop = whole && k == loop.count});
      }
      chained = leads;
    }
  }
  if (records.size() > before) records.back().end = CellRecord::End::caster;
}

/// The box around all non-empty boxes of a block of tiles.
TangentBox blockBox(const ReceiverTiles& tiles, int x0, int y0) {
  TangentBox all;
  for (int y = y0; y < std::min(y0 + kBlock, tiles.rows); ++y) {
    for (int x = x0; x < std::min(x0 + kBlock, tiles.columns); ++x) {
      const TangentBox& box = tiles.boxes[static_cast<std::size_t>(y * tiles.columns + x)];
      if (box.empty()) continue;
      if (all.empty()) {
        all = box;
        continue;
      }
      all.tLow = glm::min(all.tLow, box.tLow);
      all.tHigh = glm::max(all.tHigh, box.tHigh);
      all.iLow = std::min(all.iLow, box.iLow);
      all.iHigh = std::max(all.iHigh, box.iHigh);
    }
  }
  return all;
}

void simplifyAll(const SubLightLoops& loops, const TangentBox& receivers, BlockCasters& result) {
  result.full = false;
  result.partial.clear();
  thread_local CasterLoops simplified;
  const auto add = [&](std::span<const CasterLoops> casters) {
    for (const CasterLoops& caster : casters) {
      const bool behind = caster.low.z >= receivers.iHigh;
      if (behind && caster.layerCount > 0) continue;
      const Coverage coverage = simplify(caster, loops.light, receivers, simplified);
      if (coverage == Coverage::partial) result.partial.push_back(simplified);
      result.full = result.full || coverage == Coverage::full;
    }
  };
  add(loops.casters);
  for (const CasterLoops& caster : loops.casters) {
    if (caster.low.z >= receivers.iHigh) {
      add(std::span(loops.layers).subspan(caster.firstLayer, caster.layerCount));
    }
  }
  if (result.full) result.partial.clear();
}

TileList tileList(std::span<const SubLightLoops> subLights, std::span<const BlockCasters> block,
                  const TangentBox& receivers, ListedEdges edges, std::vector<CellRecord>& records) {
  TileList list{.first = static_cast<std::uint32_t>(records.size())};
  thread_local CasterLoops simplified;
  for (std::size_t s = 0; s < subLights.size(); ++s) {
    const std::size_t before = records.size();
    bool full = block[s].full;
    for (std::size_t c = 0; c < block[s].partial.size() && !full; ++c) {
      const Coverage coverage = simplify(block[s].partial[c], subLights[s].light, receivers, simplified);
      full = coverage == Coverage::full;
      if (coverage == Coverage::partial) {
        appendCaster(simplified, subLights[s].light, receivers, static_cast<std::uint8_t>(s), edges, records);
        if (list.casters < 255) ++list.casters;
      }
    }
    if (full) {
      records.resize(before);
    } else if (records.size() == before) {
      ++list.litSubLights;
    } else {
      records.back().end = CellRecord::End::subLight;
    }
  }
  list.count = static_cast<std::uint32_t>(records.size()) - list.first;
  if (list.count > 0) records.back().end = CellRecord::End::list;
  return list;
}
}  // namespace

CellLists cellLists(std::span<const SubLightLoops> subLights, const ReceiverTiles& tiles, ListedEdges edges) {
  CellLists lists;
  lists.tiles.resize(tiles.boxes.size());
  std::vector<BlockCasters> block(subLights.size());
  for (int y0 = 0; y0 < tiles.rows; y0 += kBlock) {
    for (int x0 = 0; x0 < tiles.columns; x0 += kBlock) {
      const TangentBox all = blockBox(tiles, x0, y0);
      if (all.empty()) continue;
      for (std::size_t s = 0; s < subLights.size(); ++s) {
        simplifyAll(subLights[s], all, block[s]);
      }
      for (int y = y0; y < std::min(y0 + kBlock, tiles.rows); ++y) {
        for (int x = x0; x < std::min(x0 + kBlock, tiles.columns); ++x) {
          const auto tile = static_cast<std::size_t>(y * tiles.columns + x);
          if (tiles.boxes[tile].empty()) {
            lists.tiles[tile].litSubLights = static_cast<std::uint8_t>(subLights.size());
            continue;
          }
          lists.tiles[tile] = tileList(subLights, block, tiles.boxes[tile], edges, lists.records);
          lists.longestList = std::max(lists.longestList, lists.tiles[tile].count);
          lists.partialTiles += lists.tiles[tile].count > 0;
        }
      }
    }
  }
  return lists;
}

TangentRect shadowedTangents(std::span<const SubLightLoops> subLights) {
  TangentRect rect;
  for (const SubLightLoops& subLight : subLights) {
    for (const CasterLoops& caster : subLight.casters) {
      if (caster.enclosesLight) return {.low = glm::dvec2(-1e9), .high = glm::dvec2(1e9)};
      for (const glm::vec3& p : caster.points) {
        // A receiver behind E is shadowed from light points up to 1 away: its tangent differs from E's by at
        // most the light's half side seen from E.
        rect.low = glm::min(rect.low, glm::dvec2(p.x - p.z, p.y - p.z));
        rect.high = glm::max(rect.high, glm::dvec2(p.x + p.z, p.y + p.z));
      }
    }
  }
  return rect;
}

}  // namespace halfshadow::techniques
