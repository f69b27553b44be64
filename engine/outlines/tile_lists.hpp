// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Lists of silhouette vertices per tile of a receiver, as fragment shaders walk them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/workers.hpp"
#include "outlines/caster_loops.hpp"
#include "outlines/receiver_tiles.hpp"

namespace halfshadow::outlines {

/// One vertex in a list. Lists begin with the trees that they lead into; then they go sub-light by sub-light,
/// caster by caster, loop by loop; a loop is its vertices and the first once more.
struct ListRecord {
  glm::vec3 ti{0.0f};
  std::uint8_t subLight = 0;
  bool startsLoop = false;  ///< no edge leads here
  bool closesLoop = false;
  bool oneSided = false;  ///< of its loop, which counts only where what it covers is positive
  /// Instead of a vertex: corner 0, 1 or 2 of a triangle that covers of the light what lies behind the plane
  /// of the receiver's own facet.
  std::int8_t behindFacet = kVertex;
  /// kTree: a tree is walked here, `tree` in TileLists::trees, for those of `treeFor`, a bit each sub-light.
  static constexpr std::int8_t kVertex = -1, kTree = 3;
  std::uint32_t tree = 0;
  std::uint8_t treeFor = 0;
  enum class End : std::uint8_t { none, caster, subLight, list } end = End::none;
  /// With End::caster: what follows is the other side of the same sheet, and the larger of both counts.
  bool firstSide = false;
};

/// Fragments walk no further: HS_LONGEST_LIST in list_vertices.glsl.
inline constexpr std::uint32_t kLongestList = 65000, kLongestListWithoutHighp = 32767;

struct TileList {
  std::uint32_t first = 0, count = 0;  ///< in TileLists::records
  std::uint8_t casters = 0;            ///< in the list; 255 = that many or more
  std::uint8_t litSubLights = 0;       ///< those that nothing but trees covers, a bit each
  bool leadsIntoTrees = false;
  /// Of whole loops: no receiver of the tile sees two of its casters before the same point of the light.
  bool apart = false;
  /// Some vertices may lie beside or behind a receiver of the tile, so that edges must be cut, or some loops
  /// are one-sided: only the walk that cuts knows those.
  bool amongReceivers = false;
};

struct TileLists {
  std::vector<TileList> tiles;  ///< one for each box of the receiver's tiles
  std::vector<ListRecord> records;
  std::uint32_t longestList = 0;
  std::size_t partialTiles = 0;  ///< tiles with a list
  bool oneSided = false;         ///< some record is
  bool amongReceivers = false;   ///< some tile is
  bool behindFacets = false;     ///< some record is of what lies behind a facet
  std::vector<const FacetTree*> trees;
  bool sides = false;     ///< some record ends a first side
  bool cutShort = false;  ///< there would be too many records: the rest is missing
  /// What making them cost: how often it was asked whether a facet in reach of a block of tiles is in reach
  /// of one of these. Once, whatever the number of sub-lights.
  std::uint64_t facetTests = 0;
};

/// Which edges of a simplified loop are listed.
enum class ListedEdges {
  covering,  ///< those that can cover part of a cell: enough for areas
  all        ///< whole loops: rectangles around what they cover need every side
};

inline constexpr std::uint32_t kNoObject = ~0u;

struct ListedReceiver {
  std::uint32_t ownObject = kNoObject;  ///< the receiver as a caster; then its tiles have patches
  /// Where more of its own, or of another's, facets are in reach of some tiles, or more records would stand
  /// for the other's, fragments walk the surface's trees.
  std::size_t mostOwnFacets = ~std::size_t{0}, mostOthersFacets = ~std::size_t{0};
  std::size_t mostOthersRecords = ~std::size_t{0};
  double detail = 0.0;  ///< of outlines: `mostShare` of dropDetail()
};

/// `subLights`: one for each quarter of the light, or one for all of it. `surfaces`: of the casters they are
/// made of. Stops, cut short, at `mostRecords`. `workers`: the same lists, whoever makes them.
TileLists tileLists(std::span<const SubLightLoops> subLights, NearSurfaces& surfaces,
                    const ReceiverTiles& tiles, const ListedReceiver& receiver, ListedEdges edges,
                    std::size_t mostRecords = ~std::size_t{0}, const Workers& workers = {});

/// Tangents in which a shadow can lie: those of the casters' points, widened by the light.
/// `farthest`: the least i of any receiver.
TangentRect shadowedTangents(std::span<const SubLightLoops> subLights, double farthest);

}  // namespace halfshadow::outlines
