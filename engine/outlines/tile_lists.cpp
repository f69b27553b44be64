// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/tile_lists.hpp"

#include <algorithm>
#include <memory>
#include <mutex>

#include "outlines/casters_apart.hpp"
#include "outlines/outline_detail.hpp"
#include "outlines/reached_facets.hpp"
#include "outlines/tree_calls.hpp"

namespace halfshadow::outlines {
namespace {
/// Tiles along a side of a block: casters are simplified for the block first, so that its tiles start from
/// few vertices.
constexpr int kBlock = 8;

/// What all lists of a receiver are made from.
struct ListJob {
  std::span<const SubLightLoops> subLights;
  NearSurfaces& surfaces;
  const ReceiverTiles& tiles;
  const ListedReceiver& receiver;
  ListedEdges edges;
  std::size_t mostRecords;

  int rows() const { return (tiles.rows + kBlock - 1) / kBlock; }  ///< of blocks
  std::size_t firstTileOf(int row) const {
    return static_cast<std::size_t>(std::min(row * kBlock, tiles.rows)) *
           static_cast<std::size_t>(tiles.columns);
  }
};

/// What may shadow a block, per sub-light.
struct BlockCasters {
  /// A caster among whose surfaces some receivers of the block stand: its faces matter there.
  struct Near {
    const CasterLoops* caster = nullptr;
    const NearSurface* surface = nullptr;
    const NearSurface* around = nullptr;  ///< some receivers of the block may stand inside it
    float deepest = 0.0f;                 ///< no point of the caster has a smaller i
    FacetChoice choice = FacetChoice::asLightSees;
    SheetSide side = SheetSide::both;  ///< of its facets
    bool known = false;                ///< another entry of the same surface stands for its facets
    bool dense = false;                ///< more facets are in reach than a list should hold
  };
  struct Partial {
    CasterLoops loops;
    const NearSurface* around = nullptr;  ///< some receivers of the block may stand inside it
  };
  std::vector<Partial> partials;  ///< with their memory; of this block the first so many
  std::size_t partialCount = 0;
  std::vector<Near> near;
  bool full = false;
  std::span<const Partial> partial() const { return std::span(partials).first(partialCount); }
  void addPartial(CasterLoops& loops, const NearSurface* around) {
    if (partialCount == partials.size()) partials.emplace_back();
    std::swap(partials[partialCount].loops, loops);
    partials[partialCount++].around = around;
  }
  void clear() {
    partialCount = 0;
    near.clear();
  }
};

/// Working memory of one thread.
struct ListScratch {
  ListScratch(std::size_t surfaces, std::size_t subLights)
      : sides{.of = std::vector<SideMemory::OfSurface>(surfaces)},
        facets(surfaces),
        block(subLights),
        sidesKnown(surfaces) {}
  SideMemory sides;
  ReachedFacets facets;
  std::vector<BlockCasters> block;  ///< by sub-light
  SimplifyScratch simplify;
  CasterLoops simplified;
  std::vector<std::uint8_t> taken;
  /// Of each surface, by its number: the sides of it that the sub-light's entries so far stand for, a bit
  /// each; and those that have some.
  std::vector<std::uint8_t> sidesKnown;
  std::vector<std::size_t> knownSurfaces;
  std::vector<TreeCall> calls;
};

/// Appends what the fragments walk. Of loops that all receivers lie behind, edges that cover nothing are left
/// out; others fragments cut at their own height and need them whole.
void appendCaster(const CasterLoops& caster, const OuterSides& sides, const TangentBox& receivers,
                  std::uint8_t subLight, ListedEdges edges, std::vector<ListRecord>& records) {
  const std::size_t before = records.size();
  for (const CasterLoops::Loop& loop : caster.loops) {
    const std::span<const glm::vec3> points = std::span(caster.points).subspan(loop.first, loop.count);
    const auto at = [&](std::uint32_t k) -> const glm::vec3& { return points[k == loop.count ? 0 : k]; };
    const bool whole = edges == ListedEdges::all || loop.oneSided ||
                       std::ranges::any_of(points, [&](const glm::vec3& p) { return p.z < receivers.iHigh; });
    bool chained = false;
    unsigned code = whole ? 0 : sides.code(points[0]);
    for (std::uint32_t k = 0; k <= loop.count; ++k) {
      bool leads = k < loop.count;
      if (leads && !whole) {
        const unsigned next = sides.code(at(k + 1));
        leads = (code & next & OuterSides::kCoversNothing) == 0;
        code = next;
      }
      if (chained || leads) {
        records.push_back({.ti = at(k),
                           .subLight = subLight,
                           .startsLoop = !chained,
                           .closesLoop = whole && k == loop.count,
                           .oneSided = loop.oneSided});
      }
      chained = leads;
    }
  }
  if (records.size() > before) records.back().end = ListRecord::End::caster;
}

/// The triangle that covers of the light what lies behind a fragment's own facet.
void appendBehindFacet(std::uint8_t subLight, std::vector<ListRecord>& records) {
  for (const std::int8_t corner : {0, 1, 2, 0}) {
    records.push_back({.subLight = subLight, .behindFacet = corner});
  }
  records[records.size() - 4].startsLoop = true;
  records.back().closesLoop = true;
  records.back().end = ListRecord::End::caster;
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

/// What stands for a caster where all receivers are behind it: its layers, or itself where it does not hide
/// itself.
void forEachLayer(const SubLightLoops& loops, const CasterLoops& caster, auto&& use) {
  if (caster.layerCount == 0 && !caster.layersBefore) use(caster);
  for (std::uint32_t l = 0; l < caster.layerCount; ++l) use(loops.layers[caster.firstLayer + l]);
}

/// No point of the caster has a smaller i.
float deepestOf(const CasterLoops& caster) {
  return caster.isRoom ? caster.deepest : std::min(caster.low.z, caster.deepest);
}

void simplifyAll(const ListJob& job, const SubLightLoops& loops, const TangentBox& receivers,
                 ListScratch& scratch, BlockCasters& result) {
  NearSurfaces& surfaces = job.surfaces;
  const ListedReceiver& receiver = job.receiver;
  result.full = false;
  result.clear();
  CasterLoops& simplified = scratch.simplified;
  const OuterSides sides(loops.light, receivers);
  const NearSurface* around = nullptr;
  const auto add = [&](const CasterLoops& caster) {
    const Coverage coverage = simplify(caster, loops.light, receivers, sides, scratch.simplify, simplified);
    if (coverage == Coverage::partial) {
      dropDetail(simplified, receivers, receiver.detail);
      result.addPartial(simplified, around);
    }
    result.full = result.full || coverage == Coverage::full;
  };
  const auto addNear = [&](const CasterLoops& caster, Solid solid) {
    BlockCasters::Near near{.caster = &caster,
                            .surface = &surfaces.of(caster.object, caster.part, solid),
                            .around = around,
                            .deepest = deepestOf(caster),
                            .choice = caster.object == receiver.ownObject ? FacetChoice::asReceiversSee
                                                                          : FacetChoice::asLightSees};
    if (near.surface->facets.empty()) return false;
    const bool isOwn = near.choice == FacetChoice::asReceiversSee;
    const std::size_t most = near.surface->spread ? ~std::size_t{0}
                             : isOwn              ? receiver.mostOwnFacets
                                                  : receiver.mostOthersFacets;
    const std::span<const std::uint32_t> all = scratch.facets.ofBlock(*near.surface, most);
    if (all.empty()) return true;
    const bool tooMany = all.size() > most;
    // The two sides of a sheet cover the same ground twice: they are two casters among its surfaces, too.
    if (!tooMany && !near.surface->closed && !isOwn)
      near.side = caster.turnedAway ? SheetSide::away : SheetSide::towards;
    std::uint8_t& sidesKnown = scratch.sidesKnown[near.surface->number];
    const auto side = static_cast<std::uint8_t>(1u << static_cast<unsigned>(near.side));
    if (sidesKnown == 0) scratch.knownSurfaces.push_back(near.surface->number);
    near.known = tooMany || (sidesKnown & side) != 0;
    near.dense = tooMany && sidesKnown == 0;
    sidesKnown |= side;
    result.near.push_back(near);
    return true;
  };
  for (const std::size_t number : scratch.knownSurfaces) scratch.sidesKnown[number] = 0;
  scratch.knownSurfaces.clear();
  std::vector<std::uint8_t>& taken = scratch.taken;
  taken.assign(loops.casters.size(), 0);
  for (const CasterCluster& cluster : loops.clusters) {
    const CasterCluster::Stage* stage = cluster.stageFor(receivers.iHigh);
    if (stage == nullptr) continue;
    add(stage->together);
    for (std::uint32_t k = 0; k < stage->members; ++k) taken[cluster.members[k]] = 1;
  }
  for (const CasterLoops& caster : loops.casters) {
    if (taken[static_cast<std::size_t>(&caster - loops.casters.data())] != 0) continue;
    if (!caster.isRoom && !caster.enclosesLight && sides.code(caster.partLow, caster.partHigh) != 0) continue;
    around = nullptr;
    const glm::vec3 low(glm::vec2(caster.low), deepestOf(caster));
    if (low.z >= receivers.iHigh) {
      // Behind all of a room is outside of it.
      result.full = result.full || caster.isRoom;
      if (!caster.isRoom) forEachLayer(loops, caster, add);
      continue;
    }
    if (caster.isRoom) {
      addNear(caster, Solid::around);
      continue;
    }
    if (caster.convex && !caster.enclosesLight && caster.object != receiver.ownObject) {
      const NearSurface& surface = surfaces.of(caster.object, caster.part);
      const Interior interior = interiorOf(surface, receivers, scratch.sides);
      if (interior != Interior::outside && hidesFromInside(surface, loops.light)) {
        result.full = result.full || interior == Interior::inside;
        around = &surface;
      }
    }
    // From within, and from its faces, the outline of a convex caster goes half round a receiver and more.
    if (around != nullptr && caster.seenInside && addNear(caster, Solid::faces)) continue;
    const bool among = !caster.enclosesLight && (!caster.convex || caster.object == receiver.ownObject);
    if (among && sides.code(low, caster.high) != 0) continue;
    if (!among || !addNear(caster, Solid::within)) add(caster);
  }
  if (result.full) result.clear();
}

TileList tileList(const ListJob& job, const ReceiverSet& set, ListScratch& scratch, TileLists& lists) {
  const std::span<const SubLightLoops> subLights = job.subLights;
  const ListedReceiver& receiver = job.receiver;
  const ListedEdges edges = job.edges;
  const std::span<const BlockCasters> block = scratch.block;
  ReachedFacets& reached = scratch.facets;
  std::vector<ListRecord>& records = lists.records;
  const TangentBox& receivers = set.box;
  TileList list{.first = static_cast<std::uint32_t>(records.size())};
  CasterLoops& simplified = scratch.simplified;
  std::vector<TreeCall>& calls = scratch.calls;
  calls.clear();
  reached.startTile(receivers);
  for (std::size_t s = 0; s < subLights.size(); ++s) {
    const std::size_t before = records.size();
    const auto bit = static_cast<std::uint8_t>(1u << s);
    const SubLightLoops& loops = subLights[s];
    const OuterSides sides(loops.light, receivers);
    bool full = block[s].full;
    const auto add = [&](Coverage coverage) {
      full = full || coverage == Coverage::full;
      if (coverage != Coverage::partial) return;
      appendCaster(simplified, sides, receivers, static_cast<std::uint8_t>(s), edges, records);
      if (list.casters < 255) ++list.casters;
    };
    for (const BlockCasters::Partial& partial : block[s].partial()) {
      if (full) break;
      const bool inside = partial.around != nullptr &&
                          interiorOf(*partial.around, receivers, scratch.sides) == Interior::inside;
      add(inside ? Coverage::full
                 : simplify(partial.loops, loops.light, receivers, sides, scratch.simplify, simplified));
    }
    const NearSurface* treed = nullptr;      // the last surface whose trees are in the list
    const NearSurface* firstSide = nullptr;  // of the sheet whose first side ends with the last record
    for (const auto& [caster, surface, around, deepest, choice, side, known, dense] : block[s].near) {
      if (full) break;
      const std::size_t own = records.size();
      if (around != nullptr && interiorOf(*around, receivers, scratch.sides) == Interior::inside) {
        full = true;
      } else if (deepest >= receivers.iHigh) {
        full = full || caster->isRoom;
        if (full) break;
        forEachLayer(loops, *caster, [&](const CasterLoops& layer) {
          if (!full) add(simplify(layer, loops.light, receivers, sides, scratch.simplify, simplified));
        });
      } else {
        // Only of its own tiles the patches are known.
        const bool isOwn = choice == FacetChoice::asReceiversSee;
        const OwnHorizon horizon = isOwn ? ownHorizon(*surface, loops.light, set) : OwnHorizon::unknown;
        if (horizon != OwnHorizon::unknown) {
          full = horizon == OwnHorizon::behind;
          if (horizon != OwnHorizon::across) continue;
          appendBehindFacet(static_cast<std::uint8_t>(s), records);
          if (list.casters < 255) ++list.casters;
          continue;
        }
        const auto leadIntoTrees = [&, walked = surface] {
          treed = walked;
          if (reached.reachesTile(*walked)) callTrees(*walked, bit, calls);
        };
        if (dense) leadIntoTrees();
        if (known || surface == treed) continue;
        const std::span<const std::uint32_t> facets = reached.ofTile(*surface);
        if (facets.empty()) continue;
        add(simplify(*surface, facets, side, loops.light, reached.lightsOf(*surface, s, loops.light),
                     isOwn ? set : ReceiverSet{.box = receivers, .space = set.space, .memory = set.memory},
                     sides, choice, scratch.simplify, simplified));
        // The sides of a sheet cover the same ground.
        const bool sided = !surface->closed && !isOwn && records.size() > own;
        if (sided && firstSide == surface) records[own - 1].firstSide = true;
        if (sided) firstSide = surface;
        if (!isOwn && !surface->spread && records.size() - own > receiver.mostOthersRecords) {
          records.resize(own);
          leadIntoTrees();
        }
      }
    }
    if (full) {
      records.resize(before);
      for (TreeCall& call : calls) call.subLights &= static_cast<std::uint8_t>(~bit);
    } else if (records.size() == before) {
      list.litSubLights |= bit;
    } else {
      records.back().end = ListRecord::End::subLight;
    }
  }
  const std::size_t treed = insertTrees(calls, receivers, list.first, job.surfaces, lists);
  list.leadsIntoTrees = treed > 0;
  list.casters = static_cast<std::uint8_t>(std::min<std::size_t>(list.casters + treed, 255));
  list.count = static_cast<std::uint32_t>(records.size()) - list.first;
  list.amongReceivers = std::ranges::any_of(std::span(records).subspan(list.first), [&](const auto& record) {
    return record.behindFacet == ListRecord::kTree || record.oneSided ||
           (record.behindFacet == ListRecord::kVertex && record.ti.z < receivers.iHigh);
  });
  list.apart = edges == ListedEdges::all && list.count > 0 && !list.amongReceivers &&
               ((list.casters == 1 && records.back().behindFacet == ListRecord::kVertex) ||
                castersApart(std::span(records).subspan(list.first), receivers));
  if (list.count > 0) {
    records.back().end = ListRecord::End::list;
  } else {
    list.first = 0;  // as where there is no receiver
  }
  return list;
}

/// Appends the lists of a row of blocks. `firstTile`: the one that TileLists::tiles begins with.
void appendRow(const ListJob& job, int row, ListScratch& scratch, std::size_t firstTile, TileLists& lists) {
  const ReceiverTiles& tiles = job.tiles;
  const int y0 = row * kBlock;
  for (int x0 = 0; x0 < tiles.columns; x0 += kBlock) {
    const TangentBox all = blockBox(tiles, x0, y0);
    if (all.empty()) continue;
    lists.cutShort = lists.records.size() > job.mostRecords;
    if (lists.cutShort) return;
    scratch.facets.startBlock(all);
    for (std::size_t s = 0; s < job.subLights.size(); ++s)
      simplifyAll(job, job.subLights[s], all, scratch, scratch.block[s]);
    for (int y = y0; y < std::min(y0 + kBlock, tiles.rows); ++y) {
      for (int x = x0; x < std::min(x0 + kBlock, tiles.columns); ++x) {
        const auto tile = static_cast<std::size_t>(y * tiles.columns + x);
        TileList& list = lists.tiles[tile - firstTile];
        if (tiles.boxes[tile].empty()) {
          list.litSubLights = static_cast<std::uint8_t>((1u << job.subLights.size()) - 1);
          continue;
        }
        ++scratch.sides.tile;
        list = tileList(job,
                        {.box = tiles.boxes[tile],
                         .space = job.surfaces.space(),
                         .memory = scratch.sides,
                         .patches = tiles.patchesOf(tile)},
                        scratch, lists);
        lists.longestList = std::max(lists.longestList, list.count);
        lists.partialTiles += list.count > 0;
      }
    }
  }
}

/// Appends to `lists` those of a row of blocks that were made apart, as appendRow() had made them here.
void joinRow(const ListJob& job, int row, const TileLists& apart, TileLists& lists) {
  const auto before = static_cast<std::uint32_t>(lists.records.size());
  std::vector<std::uint32_t> numberOf;
  for (const FacetTree* tree : apart.trees) {
    const auto found = std::ranges::find(lists.trees, tree);
    numberOf.push_back(static_cast<std::uint32_t>(found - lists.trees.begin()));
    if (found == lists.trees.end()) lists.trees.push_back(tree);
  }
  lists.records.insert(lists.records.end(), apart.records.begin(), apart.records.end());
  for (ListRecord& record : std::span(lists.records).subspan(before)) {
    if (record.behindFacet == ListRecord::kTree) record.tree = numberOf[record.tree];
  }
  for (std::size_t k = 0; k < apart.tiles.size(); ++k) {
    TileList& list = lists.tiles[job.firstTileOf(row) + k];
    list = apart.tiles[k];
    if (list.count > 0) list.first += before;
  }
  lists.longestList = std::max(lists.longestList, apart.longestList);
  lists.partialTiles += apart.partialTiles;
  lists.cutShort = lists.cutShort || apart.cutShort || lists.records.size() > job.mostRecords;
}

/// Row by row on the host's threads.
std::uint64_t makeApart(const ListJob& job, const Workers& workers, TileLists& lists) {
  std::vector<std::unique_ptr<ListScratch>> idle;
  std::mutex idleMutex;
  const auto take = [&] {
    const std::lock_guard lock(idleMutex);
    if (idle.empty()) return std::make_unique<ListScratch>(job.surfaces.count(), job.subLights.size());
    std::unique_ptr<ListScratch> scratch = std::move(idle.back());
    idle.pop_back();
    return scratch;
  };
  std::vector<TileLists> rows(static_cast<std::size_t>(job.rows()));
  workers.forEach(rows.size(), [&](std::size_t r) {
    const int row = static_cast<int>(r);
    const std::size_t first = job.firstTileOf(row);
    rows[r].tiles.resize(job.firstTileOf(row + 1) - first);
    std::unique_ptr<ListScratch> scratch = take();
    appendRow(job, row, *scratch, first, rows[r]);
    const std::lock_guard lock(idleMutex);
    idle.push_back(std::move(scratch));
  });
  for (std::size_t r = 0; r < rows.size(); ++r) joinRow(job, static_cast<int>(r), rows[r], lists);
  std::uint64_t tests = 0;
  for (const auto& scratch : idle) tests += scratch->facets.facetTests();
  return tests;
}
}  // namespace

TileLists tileLists(std::span<const SubLightLoops> subLights, NearSurfaces& surfaces,
                    const ReceiverTiles& tiles, const ListedReceiver& receiver, ListedEdges edges,
                    std::size_t mostRecords, const Workers& workers) {
  const ListJob job{subLights, surfaces, tiles, receiver, edges, mostRecords};
  TileLists lists;
  lists.tiles.resize(tiles.boxes.size());
  if (workers.lent()) {
    lists.facetTests = makeApart(job, workers, lists);
  } else {
    ListScratch scratch(surfaces.count(), subLights.size());
    for (int row = 0; row < job.rows() && !lists.cutShort; ++row) appendRow(job, row, scratch, 0, lists);
    lists.facetTests = scratch.facets.facetTests();
  }
  if (lists.cutShort) return lists;
  lists.oneSided = std::ranges::any_of(lists.records, &ListRecord::oneSided);
  lists.behindFacets = std::ranges::any_of(
      lists.records, [](const ListRecord& record) { return record.behindFacet != ListRecord::kVertex; });
  lists.sides = std::ranges::any_of(lists.records, &ListRecord::firstSide);
  lists.amongReceivers = std::ranges::any_of(lists.tiles, &TileList::amongReceivers);
  return lists;
}

TangentRect shadowedTangents(std::span<const SubLightLoops> subLights, double farthest) {
  TangentRect rect;
  for (const SubLightLoops& subLight : subLights) {
    for (const CasterLoops& caster : subLight.casters) {
      if (caster.enclosesLight || caster.isRoom) return {.low = glm::dvec2(-1e30), .high = glm::dvec2(1e30)};
      for (const glm::vec3& point : caster.points) {
        // A receiver behind E is shadowed from light points up to 1 away: its tangent differs from E's by at
        // most the light's half side as it grows from E's height to the receiver's.
        const glm::dvec3 p(point);
        const double spread = std::max(p.z - farthest, 0.0);
        rect.low = glm::min(rect.low, glm::dvec2(p) - spread);
        rect.high = glm::max(rect.high, glm::dvec2(p) + spread);
      }
    }
  }
  return rect;
}

}  // namespace halfshadow::outlines
