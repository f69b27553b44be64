// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Vertex lists as two RGBA8 textures: tiles (where a list begins) and records (two texels each).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "outlines/tile_lists.hpp"
#include "techniques/parts/lists/list_codes.hpp"

namespace halfshadow::techniques {

/// Records in a row of the record image; lists may go on in the next row.
inline constexpr int kRecordsPerRow = 256;

/// RGBA bytes, rows of `width` texels.
struct ListImage {
  int width = 1, height = 1;
  std::shared_ptr<const std::vector<std::uint8_t>> rgba;
};

/// A tile's texel: record column, record row (low, high byte), the number of sub-lights that nothing covers
/// (of a list that leads into trees: a bit each) + 16 where there is a list, + 32 where its casters are
/// apart,
/// + 64 where vertices lie among the receivers. What leads into a tree holds its first record (column, row:
/// low, high byte) and the sub-lights that it counts for in place of a vertex. A list begins with a record of
/// its own: its centre, in 256 steps each, and the exponents of two of its steps along t and along i, each +
/// 128. A record's texels: t.x and t.y in two bytes each, high first; then i, tag, scale: the vertex is
/// center + (value - 32768) · scale² · step. The tag is in list_vertices.glsl.
struct EncodedLists {
  ListImage tiles, records;
  std::size_t rows = 0;                ///< of the records
  std::vector<glm::ivec2> firstTexel;  ///< of each receiver's tiles
  /// Of each list, receiver by receiver: in records, and how it is stored; none where there is no list.
  struct Placed : ListPlacement {
    std::uint32_t firstRecord = 0;
  };
  std::vector<Placed> lists;
};

/// One receiver's lists and the shape of its grid.
struct ReceiverLists {
  const outlines::TileLists* lists = nullptr;
  int columns = 0, rows = 0;
};

/// Empty result (no receivers' texels) when the records need more than `maxRows` rows.
bool encodeLists(std::span<const ReceiverLists> receivers, int maxRows, EncodedLists& result);

}  // namespace halfshadow::techniques
