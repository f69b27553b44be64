// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Vertex lists as two RGBA8 textures: tiles (where a list begins) and records (two texels each).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "techniques/caster_lists/cell_lists.hpp"

namespace halfshadow::techniques {

/// Records in a row of the record image; lists may go on in the next row.
inline constexpr int kRecordsPerRow = 256;

/// RGBA bytes, rows of `width` texels.
struct ListImage {
  int width = 1, height = 1;
  std::vector<std::uint8_t> rgba;
};

/// A tile's texel: record column, record row (low, high byte), sub-lights that nothing covers + 16 where
/// there is a list. A record's texels: t.x and t.y in two bytes each, high first; then i, tag, scale: the
/// vertex is center + (value - 32768) · scale · step. The tag is in caster_lists.glsl.
struct EncodedLists {
  ListImage tiles, records;
  std::size_t rows = 0;                ///< of the records
  std::vector<glm::ivec2> firstTexel;  ///< of each receiver's tiles
  glm::vec3 center{0.0f}, step{1.0f};  ///< (t, i)
};

/// One receiver's lists and the shape of its grid.
struct ReceiverLists {
  const CellLists* lists = nullptr;
  int columns = 0, rows = 0;
};

/// Empty result (no receivers' texels) when the records need more than `maxRows` rows.
bool encodeLists(std::span<const ReceiverLists> receivers, int maxRows, EncodedLists& result);

}  // namespace halfshadow::techniques
