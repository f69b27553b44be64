// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/list_textures.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <ranges>

#include "techniques/parts/lists/facet_tree_texels.hpp"

namespace halfshadow::techniques {
namespace {
/// Widest grid plus room: tiles of several receivers stand side by side.
constexpr int kTileImageWidth = 1024;

/// The largest factor of a step: the square of a byte.
constexpr float kLargestScale = 255.0f * 255.0f;

/// Vertices farther from the receivers than the nearest one, as seen in i, by this factor are coded with a
/// coarser step: what they project to is known to the same share.
constexpr float kFineReach = 8.0f;
/// Corners of facets on which receivers stand have fine steps, too, up to so many times the others' range.
constexpr float kFacetReach = 32.0f;
/// Between steps of t and of i, where vertices are coded with coarser ones.
constexpr float kUneven = 8.0f;

struct Range {
  glm::vec3 low{1e30f}, high{-1e30f};
  void include(const glm::vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
};

/// How the vertices of one list are stored: about the middle of those that are not much nearer to the light
/// than the others, so that neither far casters nor wide receivers make a near vertex coarse.
EncodedLists::Placed placementOf(std::span<const outlines::ListRecord> records) {
  float farthest = 1e30f, nearest = -1e30f;
  bool oneSided = false;
  const auto isVertex = [](const outlines::ListRecord& record) {
    return record.behindFacet == outlines::ListRecord::kVertex;
  };
  for (const outlines::ListRecord& record : records) {
    if (!isVertex(record)) continue;
    farthest = std::min(farthest, record.ti.z);
    nearest = std::max(nearest, record.ti.z);
    oneSided |= record.oneSided;
  }
  if (farthest > nearest) return {};
  const float fineUpTo = farthest + (nearest - farthest) / kFineReach;
  Range fine;
  for (const outlines::ListRecord& record : records) {
    if (isVertex(record) && record.ti.z <= fineUpTo) fine.include(record.ti);
  }
  // Receivers may stand on the facets of one-sided loops, off by no more than a step; but not where that
  // would make the steps of all others much coarser.
  const glm::vec3 middle = 0.5f * (fine.low + fine.high), range = fine.high - fine.low;
  const glm::vec3 reach(kFacetReach * std::max({range.x, range.y, range.z}));
  for (const outlines::ListRecord& record : oneSided ? records : records.first(0)) {
    if (isVertex(record) && record.oneSided &&
        glm::all(glm::lessThanEqual(glm::abs(record.ti - middle), reach)))
      fine.include(record.ti);
  }
  EncodedLists::Placed placed;
  placed.center = 0.5f * (fine.low + fine.high);
  glm::vec3 farthestOff(0.0f);
  for (const outlines::ListRecord& record : records)
    if (isVertex(record)) farthestOff = glm::max(farthestOff, glm::abs(record.ti - placed.center));
  glm::vec3 least = glm::max(farthestOff / (32766.0f * kLargestScale), (fine.high - fine.low) / 65534.0f);
  // The scale of a vertex is that of its farthest coordinate: steps of the others must not be much coarser,
  // or it must not need one.
  const float along = std::max(least.x, least.y);
  least.z = std::max(least.z, std::min(along / kUneven, farthestOff.z / 32766.0f));
  for (int k = 0; k < 2; ++k)
    least[k] = std::max(least[k], std::min(least.z / kUneven, farthestOff[k] / 32766.0f));
  placed = {placementAbout(placed.center, least)};
  return placed;
}

/// `perStep`: 1 over the placement's steps, which are powers of two.
void encodeRecord(const outlines::ListRecord& record, const EncodedLists::Placed& placed,
                  const glm::vec3& perStep, std::uint8_t* texels) {
  const bool isVertex = record.behindFacet == outlines::ListRecord::kVertex;
  glm::vec3 offset =
      isVertex ? (record.ti - placed.center) * perStep : glm::vec3(record.behindFacet, 0.0f, 0.0f);
  const float largest = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
  float scale = 1.0f;
  if (largest > 32767.0f) {
    scale = std::clamp(std::ceil(std::sqrt(largest / 32767.0f)), 1.0f, 255.0f);
    offset /= scale * scale;
  }
  for (int k = 0; k < 3; ++k) putCode(offset[k], texels + 2 * k);
  texels[6] = static_cast<std::uint8_t>((record.subLight & 1 ? 128 : 0) | (record.subLight & 2 ? 64 : 0) |
                                        (record.startsLoop || record.firstSide ? 32 : 0) |
                                        (record.closesLoop ? 16 : 0) | (record.oneSided ? 8 : 0) |
                                        (isVertex ? 0 : 4) | static_cast<int>(record.end));
  texels[7] = static_cast<std::uint8_t>(scale);
}

/// A record that leads into a tree which begins at record `first`.
void encodeCall(const outlines::ListRecord& record, std::size_t first, std::uint8_t* texels) {
  encodeRecord(record, {}, glm::vec3(1.0f), texels);
  texels[2] = static_cast<std::uint8_t>(first % kRecordsPerRow);
  texels[3] = static_cast<std::uint8_t>(first / kRecordsPerRow & 255);
  texels[4] = static_cast<std::uint8_t>(first / kRecordsPerRow >> 8);
  texels[5] = record.treeFor;
}

/// Trees that some list leads into, each once, and the first record of each.
class PlacedTrees {
 public:
  explicit PlacedTrees(std::span<const ReceiverLists> receivers) {
    for (const ReceiverLists& receiver : receivers) {
      for (const outlines::FacetTree* tree : receiver.lists->trees) {
        if (!first_.try_emplace(tree, count_).second) continue;
        records_.push_back(encodedTree(*tree));
        count_ += records_.back().size() / kRecordBytes;
      }
    }
  }
  std::size_t recordCount() const { return count_; }
  std::size_t firstOf(const outlines::FacetTree* tree) const { return first_.at(tree); }
  /// One after the other.
  void copyTo(std::uint8_t* texels) const {
    for (const std::vector<std::uint8_t>& records : records_) texels = std::ranges::copy(records, texels).out;
  }

 private:
  std::map<const outlines::FacetTree*, std::size_t> first_;
  std::vector<std::vector<std::uint8_t>> records_;
  std::size_t count_ = 0;
};

std::vector<std::uint8_t> blankTexels(const ListImage& image) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(image.width) *
                                   static_cast<std::size_t>(image.height) * 4);
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
  return {.width = kTileImageWidth, .height = std::max(y + shelf, 1)};
}
}  // namespace

bool encodeLists(std::span<const ReceiverLists> receivers, int maxRows, EncodedLists& result) {
  result = {};
  const PlacedTrees trees(receivers);
  std::size_t recordCount = trees.recordCount();
  for (const ReceiverLists& receiver : receivers) {
    recordCount += receiver.lists->records.size();
    for (const outlines::TileList& list : receiver.lists->tiles) recordCount += list.count > 0;
  }
  const std::size_t rows = std::max<std::size_t>((recordCount + kRecordsPerRow - 1) / kRecordsPerRow, 1);
  if (rows > static_cast<std::size_t>(maxRows)) return false;
  result.rows = rows;
  // Rows grow in powers of two, so that the texture seldom changes its size.
  std::size_t height = 1;
  while (height < rows) height *= 2;
  result.records = {.width = 2 * kRecordsPerRow,
                    .height = static_cast<int>(std::min(height, static_cast<std::size_t>(maxRows)))};
  std::vector<std::uint8_t> recordTexels = blankTexels(result.records);
  result.tiles = placeTiles(receivers, result.firstTexel);
  std::vector<std::uint8_t> tileTexels = blankTexels(result.tiles);
  trees.copyTo(recordTexels.data());
  std::size_t next = trees.recordCount();
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const ReceiverLists& receiver = receivers[r];
    for (std::size_t t = 0; t < receiver.lists->tiles.size(); ++t) {
      const outlines::TileList& list = receiver.lists->tiles[t];
      const std::size_t x =
          static_cast<std::size_t>(result.firstTexel[r].x) + t % std::size_t(receiver.columns);
      const std::size_t y =
          static_cast<std::size_t>(result.firstTexel[r].y) + t / std::size_t(receiver.columns);
      std::uint8_t* texel = &tileTexels[(y * std::size_t(kTileImageWidth) + x) * 4];
      texel[0] = static_cast<std::uint8_t>(next % kRecordsPerRow);
      texel[1] = static_cast<std::uint8_t>(next / kRecordsPerRow & 255);
      texel[2] = static_cast<std::uint8_t>(next / kRecordsPerRow >> 8);
      // Of what trees cover fragments must know which they are.
      const int lit = list.leadsIntoTrees ? list.litSubLights : std::popcount(list.litSubLights);
      texel[3] = static_cast<std::uint8_t>(lit | (list.count > 0 ? 16 : 0) | (list.apart ? 32 : 0) |
                                           (list.amongReceivers ? 64 : 0));
      EncodedLists::Placed& placed = result.lists.emplace_back();
      if (list.count == 0) continue;
      const auto records = std::span(receiver.lists->records).subspan(list.first, list.count);
      placed = placementOf(records);
      placed.firstRecord = static_cast<std::uint32_t>(next);
      encodePlacement(placed, &recordTexels[next++ * kRecordBytes]);
      const glm::vec3 perStep = 1.0f / placed.step;
      for (const outlines::ListRecord& record : records) {
        std::uint8_t* const texels = &recordTexels[next++ * kRecordBytes];
        if (record.behindFacet == outlines::ListRecord::kTree) {
          encodeCall(record, trees.firstOf(receiver.lists->trees[record.tree]), texels);
        } else {
          encodeRecord(record, placed, perStep, texels);
        }
      }
    }
  }
  result.records.rgba = std::make_shared<const std::vector<std::uint8_t>>(std::move(recordTexels));
  result.tiles.rgba = std::make_shared<const std::vector<std::uint8_t>>(std::move(tileTexels));
  return true;
}

}  // namespace halfshadow::techniques
