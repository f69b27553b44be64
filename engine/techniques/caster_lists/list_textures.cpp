// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/caster_lists/list_textures.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::techniques {
namespace {
/// Vertices this much nearer to the light than the farthest one are coded with a coarser step: they project
/// far outside the light, or their casters touch it.
constexpr float kFineReach = 8.0f;

/// Widest grid plus room: tiles of several receivers stand side by side.
constexpr int kTileImageWidth = 1024;

struct Range {
  glm::vec3 low{1e30f}, high{-1e30f};
  void include(const glm::vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
};

Range fineRange(std::span<const ReceiverLists> receivers) {
  float farthest = 1e30f;
  for (const ReceiverLists& receiver : receivers) {
    for (const CellRecord& record : receiver.lists->records) farthest = std::min(farthest, record.ti.z);
  }
  Range range;
  for (const ReceiverLists& receiver : receivers) {
    for (const CellRecord& record : receiver.lists->records) {
      if (record.ti.z <= farthest * kFineReach) range.include(record.ti);
    }
  }
  return range;
}

/// The step of each coordinate: fine, and wide enough for the coarsest code to reach every vertex, since a
/// clamped coordinate would turn edges.
glm::vec3 stepOf(std::span<const ReceiverLists> receivers, const Range& fine, const glm::vec3& center) {
  glm::vec3 farthest(0.0f);
  for (const ReceiverLists& receiver : receivers) {
    for (const CellRecord& record : receiver.lists->records)
      farthest = glm::max(farthest, glm::abs(record.ti - center));
  }
  return glm::max(glm::max((fine.high - fine.low) / 65534.0f, farthest / (32766.0f * 255.0f)),
                  glm::vec3(1e-12f));
}

void encodeRecord(const CellRecord& record, const glm::vec3& center, const glm::vec3& step,
                  std::uint8_t* texels) {
  const glm::vec3 offset = (record.ti - center) / step;
  const float largest = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
  const float scale = std::clamp(std::ceil(largest / 32767.0f), 1.0f, 255.0f);
  for (int k = 0; k < 3; ++k) {
    const auto value =
        static_cast<int>(std::clamp(std::round(offset[k] / scale), -32768.0f, 32767.0f)) + 32768;
    texels[2 * k] = static_cast<std::uint8_t>(value >> 8);
    texels[2 * k + 1] = static_cast<std::uint8_t>(value & 255);
  }
  texels[6] = static_cast<std::uint8_t>((record.subLight & 1 ? 128 : 0) | (record.subLight & 2 ? 64 : 0) |
                                        (record.startsLoop ? 32 : 0) | (record.closesLoop ? 16 : 0) |
                                        (record.oneSided ? 8 : 0) | static_cast<int>(record.end));
  texels[7] = static_cast<std::uint8_t>(scale);
}

/// Shelves: receivers side by side, a new row of them where the image ends.
ListImage placeTiles(std::span<const ReceiverLists> receivers, std::vector<glm::ivec2>& firstTexel) {
  int x = 0, y = 0, shelf = 0;
  for (const ReceiverLists& receiver : receivers) {
    if (x + receiver.columns > kTileImageWidth) {
      x = 0;
      y += shelf;
      shelf = 0;
    }
    firstTexel.emplace_back(x, y);
    x += receiver.columns;
    shelf = std::max(shelf, receiver.rows);
  }
  ListImage image{.width = kTileImageWidth, .height = std::max(y + shelf, 1)};
  image.rgba.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4);
  return image;
}
}  // namespace

bool encodeLists(std::span<const ReceiverLists> receivers, int maxRows, EncodedLists& result) {
  result = {};
  std::size_t recordCount = 0;
  for (const ReceiverLists& receiver : receivers) recordCount += receiver.lists->records.size();
  const std::size_t rows = std::max<std::size_t>((recordCount + kRecordsPerRow - 1) / kRecordsPerRow, 1);
  if (rows > static_cast<std::size_t>(maxRows)) return false;
  result.rows = rows;
  if (recordCount > 0) {
    const Range range = fineRange(receivers);
    result.center = 0.5f * (range.low + range.high);
    result.step = stepOf(receivers, range, result.center);
  }
  // Rows grow in powers of two, so that the texture seldom changes its size.
  std::size_t height = 1;
  while (height < rows) height *= 2;
  result.records = {.width = 2 * kRecordsPerRow,
                    .height = static_cast<int>(std::min(height, static_cast<std::size_t>(maxRows)))};
  result.records.rgba.resize(static_cast<std::size_t>(result.records.width) *
                             static_cast<std::size_t>(result.records.height) * 4);
  result.tiles = placeTiles(receivers, result.firstTexel);
  std::size_t next = 0;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const ReceiverLists& receiver = receivers[r];
    for (std::size_t k = 0; k < receiver.lists->records.size(); ++k) {
      encodeRecord(receiver.lists->records[k], result.center, result.step,
                   &result.records.rgba[(next + k) * 8]);
    }
    for (std::size_t t = 0; t < receiver.lists->tiles.size(); ++t) {
      const TileList& list = receiver.lists->tiles[t];
      const std::size_t record = next + list.first;
      const std::size_t x =
          static_cast<std::size_t>(result.firstTexel[r].x) + t % std::size_t(receiver.columns);
      const std::size_t y =
          static_cast<std::size_t>(result.firstTexel[r].y) + t / std::size_t(receiver.columns);
      std::uint8_t* texel = &result.tiles.rgba[(y * std::size_t(kTileImageWidth) + x) * 4];
      texel[0] = static_cast<std::uint8_t>(record % kRecordsPerRow);
      texel[1] = static_cast<std::uint8_t>(record / kRecordsPerRow & 255);
      texel[2] = static_cast<std::uint8_t>(record / kRecordsPerRow >> 8);
      texel[3] =
          static_cast<std::uint8_t>(list.litSubLights | (list.count > 0 ? 16 : 0) | (list.apart ? 32 : 0));
    }
    next += receiver.lists->records.size();
  }
  return true;
}

}  // namespace halfshadow::techniques
