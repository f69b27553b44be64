// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedge_volumes/wedge_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::techniques {
namespace {

void addPiece(const std::vector<glm::vec3>& polygon, std::size_t first, std::size_t count,
              WedgePieces& result) {
  const glm::dvec3 grid(result.stepAB, result.stepAB, result.stepH);
  WedgePiece piece{.firstVertex = static_cast<std::uint32_t>(result.vertices.size()),
                   .vertexCount = static_cast<std::uint32_t>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec3 vertex = glm::round(glm::dvec3(polygon[(first + i) % polygon.size()]) / grid) * grid;
    vertex.z = std::max(vertex.z, result.stepH);
    result.vertices.emplace_back(vertex);
    piece.extent.include(vertex);
  }
  result.pieces.push_back(piece);
}

/// Runs of edges become pieces closed by their chords; the chords are a shorter loop, cut in the same way.
void cutLoop(std::vector<glm::vec3> loop, WedgePieces& result) {
  while (loop.size() > kPieceVertices) {
    constexpr std::size_t kEdges = kPieceVertices - 1;
    const std::size_t runs = (loop.size() + kEdges - 1) / kEdges;
    std::vector<glm::vec3> chords;
    for (std::size_t run = 0; run < runs; ++run) {
      const std::size_t first = run * loop.size() / runs, last = (run + 1) * loop.size() / runs;
      if (last - first >= 2) addPiece(loop, first, last - first + 1, result);
      chords.push_back(loop[first]);
    }
    loop = std::move(chords);
  }
  if (loop.size() >= 3) addPiece(loop, 0, loop.size(), result);
}

/// Casters of several pieces are added up before they are combined, a batch at a time.
void assignBatches(WedgePieces& result, double farthest) {
  std::vector<std::vector<std::uint32_t>> batches;
  for (std::uint32_t i = 0; i < result.casters.size(); ++i) {
    WedgeCaster& caster = result.casters[i];
    if (caster.pieceCount < 2) continue;
    const auto fits = std::ranges::find_if(batches, [&](const std::vector<std::uint32_t>& batch) {
      return std::ranges::none_of(batch, [&](std::uint32_t other) {
        return caster.extent.meets(result.casters[other].extent, farthest);
      });
    });
    caster.batch = static_cast<std::uint32_t>(fits - batches.begin());
    if (fits == batches.end()) batches.emplace_back();
    batches[caster.batch].push_back(i);
  }
  result.batchCount = static_cast<std::uint32_t>(batches.size());
}
}  // namespace

void WedgeExtent::include(const glm::dvec3& abh) {
  lowA = std::min(lowA, (abh.x - lightHigh.x) / abh.z);
  highA = std::max(highA, (abh.x - lightLow.x) / abh.z);
  lowB = std::min(lowB, (abh.y - lightHigh.y) / abh.z);
  highB = std::max(highB, (abh.y - lightLow.y) / abh.z);
  nearest = std::min(nearest, abh.z), farthest = std::max(farthest, abh.z);
}

void WedgeExtent::include(const WedgeExtent& other) {
  lowA = std::min(lowA, other.lowA), highA = std::max(highA, other.highA);
  lowB = std::min(lowB, other.lowB), highB = std::max(highB, other.highB);
  nearest = std::min(nearest, other.nearest), farthest = std::max(farthest, other.farthest);
}

bool WedgeExtent::meets(const WedgeExtent& other, double end) const {
  return meetsBetween(other, std::max(nearest, other.nearest), end);
}

bool WedgeExtent::meetsBetween(const WedgeExtent& other, double from, double end) const {
  if (from > end) return false;
  // Sides are linear in h: two rectangles apart on one side at both ends are apart between them.
  const auto apart = [&](const WedgeExtent& left, const WedgeExtent& right) {
    const auto a = glm::lessThan(left.high(from), right.low(from));
    const auto b = glm::lessThan(left.high(end), right.low(end));
    return (a.x && b.x) || (a.y && b.y);
  };
  return !apart(*this, other) && !apart(other, *this);
}

void makeWedgePieces(const scene::LightSilhouettes& silhouettes, double farthest, WedgePieces& result) {
  result.vertices.clear();
  result.pieces.clear();
  result.casters.clear();
  double outermost = 1.0;
  for (const glm::dvec3& point : silhouettes.points)
    outermost = std::max<double>({outermost, std::abs(point.x), std::abs(point.y)});
  result.stepAB = std::exp2(std::ceil(std::log2(outermost / kGridSteps)));
  result.stepH = 1.0 / kGridSteps;
  for (const scene::LightSilhouettes::Caster& caster : silhouettes.casters) {
    WedgeCaster made{.object = caster.object, .firstPiece = static_cast<std::uint32_t>(result.pieces.size())};
    for (std::uint32_t l = caster.firstLoop; l < caster.firstLoop + caster.loopCount; ++l) {
      const auto first = silhouettes.points.begin() + silhouettes.loops[l].first;
      cutLoop(std::vector<glm::vec3>(first, first + silhouettes.loops[l].count), result);
    }
    made.pieceCount = static_cast<std::uint32_t>(result.pieces.size()) - made.firstPiece;
    for (std::uint32_t p = 0; p < made.pieceCount; ++p)
      made.extent.include(result.pieces[made.firstPiece + p].extent);
    // Beyond the farthest receiver, nothing can be shadowed.
    if (made.pieceCount > 0 && made.extent.nearest < farthest) result.casters.push_back(made);
  }
  assignBatches(result, farthest);
}

}  // namespace halfshadow::techniques
