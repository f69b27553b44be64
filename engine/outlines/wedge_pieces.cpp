// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "outlines/wedge_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "scene/bounds.hpp"

namespace halfshadow::outlines {
namespace {

/// Single precision keeps this much of a coordinate, less what arithmetic with it takes.
constexpr double kRounding = 1.0 / (1 << 22);

/// A caster's step: its grid has kGridSteps over what its loops reach, but none that single precision would
/// not tell apart so far from the anchor.
double stepOf(const scene::LightSilhouettes& silhouettes, const scene::LightSilhouettes::Caster& caster,
              const glm::dvec3& units) {
  scene::Bounds bounds;
  for (std::uint32_t l = caster.firstLoop; l < caster.firstLoop + caster.loopCount; ++l) {
    const scene::LightSilhouettes::Loop& loop = silhouettes.loops[l];
    for (std::uint32_t i = 0; i < loop.count; ++i)
      bounds.include((silhouettes.points[loop.first + i] - glm::dvec3(0, 0, 1)) / units);
  }
  if (bounds.empty()) return 1.0;
  const auto largest = [](const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); };
  const double size = largest(bounds.high - bounds.low);
  const double away = largest(glm::max(glm::abs(bounds.low), glm::abs(bounds.high)));
  return std::exp2(std::ceil(std::log2(std::max({size / kGridSteps, away * kRounding, 1e-300}))));
}

/// The nearest point of the grid that is before the light.
glm::dvec3 onGrid(const glm::dvec3& abh, const glm::dvec3& units, double step) {
  const glm::dvec3 anchor(0, 0, 1), grid = units * step;
  glm::dvec3 steps = glm::round((abh - anchor) / grid);
  steps.z = std::max(steps.z, std::floor(-1.0 / step) + 1.0);
  return anchor + steps * grid;
}

void addPiece(const std::vector<glm::dvec3>& polygon, std::size_t first, std::size_t count, double step,
              WedgePieces& result) {
  WedgePiece piece{.firstVertex = static_cast<std::uint32_t>(result.vertices.size()),
                   .vertexCount = static_cast<std::uint32_t>(count),
                   .step = step};
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3& vertex = polygon[(first + i) % polygon.size()];
    result.vertices.push_back(vertex);
    piece.extent.include(vertex);
  }
  result.pieces.push_back(piece);
}

/// Runs of edges become pieces closed by their chords; the chords are a shorter loop, cut in the same way.
void cutLoop(std::vector<glm::dvec3> loop, double step, WedgePieces& result) {
  while (loop.size() > kPieceVertices) {
    constexpr std::size_t kEdges = kPieceVertices - 1;
    const std::size_t runs = (loop.size() + kEdges - 1) / kEdges;
    std::vector<glm::dvec3> chords;
    for (std::size_t run = 0; run < runs; ++run) {
      const std::size_t first = run * loop.size() / runs, last = (run + 1) * loop.size() / runs;
      if (last - first >= 2) addPiece(loop, first, last - first + 1, step, result);
      chords.push_back(loop[first]);
    }
    loop = std::move(chords);
  }
  if (loop.size() >= 3) addPiece(loop, 0, loop.size(), step, result);
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

glm::dvec3 wedgeUnits(const scene::LightPlane& plane) {
  const double unit = glm::length(plane.toUnitHeight);
  const auto power = [](double ratio) { return std::exp2(std::round(std::log2(ratio))); };
  return {power(unit / glm::length(plane.halfU)), power(unit / glm::length(plane.halfV)), 1.0};
}

void makeWedgePieces(const scene::LightSilhouettes& silhouettes, const glm::dvec3& units, double farthest,
                     WedgePieces& result) {
  result.vertices.clear();
  result.pieces.clear();
  result.casters.clear();
  result.units = units;
  for (const scene::LightSilhouettes::Caster& caster : silhouettes.casters) {
    WedgeCaster made{.object = caster.object,
                     .firstPiece = static_cast<std::uint32_t>(result.pieces.size()),
                     .step = stepOf(silhouettes, caster, units)};
    for (std::uint32_t l = caster.firstLoop; l < caster.firstLoop + caster.loopCount; ++l) {
      const auto first = silhouettes.points.begin() + silhouettes.loops[l].first;
      std::vector<glm::dvec3> loop(first, first + silhouettes.loops[l].count);
      for (glm::dvec3& vertex : loop) vertex = onGrid(vertex, units, made.step);
      cutLoop(std::move(loop), made.step, result);
    }
    made.pieceCount = static_cast<std::uint32_t>(result.pieces.size()) - made.firstPiece;
    for (std::uint32_t p = 0; p < made.pieceCount; ++p)
      made.extent.include(result.pieces[made.firstPiece + p].extent);
    // Beyond the farthest receiver, nothing can be shadowed.
    if (made.pieceCount > 0 && made.extent.nearest < farthest) result.casters.push_back(made);
  }
  assignBatches(result, farthest);
}

}  // namespace halfshadow::outlines
