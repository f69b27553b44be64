// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/wedges/wedge_volumes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "base/keys.hpp"
#include "outlines/caster_clusters.hpp"
#include "outlines/wedge_bounds.hpp"
#include "scene/light_anchor.hpp"
#include "techniques/parts/wedges/volume_boxes.hpp"

namespace halfshadow::techniques {
namespace {
/// Volumes end so much farther from the light than the receivers that they are for.
constexpr double kBeyondReceiver = 1.01;
/// Nearest height of a caster, in units of the nearest caster's distance: what reaches behind the light is
/// cut here.
constexpr double kMinHeight = 1e-6;
/// Half a side of the smallest light, in the same unit: penumbrae that no picture shows, or that 11 bits of a
/// receiver's place do not.
constexpr double kMinHalfLength = 1e-5, kMinHalfLengthWithoutHighp = 5e-4;

/// A receiver so far behind all vertices of a piece, in units of its size, needs no clipping:
/// HS_WEDGE_ALL_NEAR.
constexpr double kAllNear = 1e-3, kAllNearWithoutHighp = 4e-3;
/// And none that is this share of its distance from the eye.
constexpr double kAllNearOfDistance = 10.0 * kNearOfDistance;

/// Two boxes a piece: receivers in the first may need clipping, those in the second may not; fragments tell.
constexpr int kCorners = 16, kIndices = kVolumeIndices;
constexpr std::size_t kPiecesPerDraw = volumesPerDraw(kCorners);

/// A whole number of steps that a piece's centre is rounded to: wedge_piece.glsl.
constexpr double kCenterSteps = 64.0;
/// Steps of the grid that are one unit without highp: a thousand units hold every caster.
constexpr double kStepsWithoutHighp = outlines::kGridSteps / 1024.0;

struct Vertex {
  glm::vec3 corner;
  /// Of the piece, in steps of the grid from the centre.
  std::array<float, outlines::kPieceVertices> a, b, h;
  glm::vec3 center;    ///< in units of kCenterSteps
  float stepExponent;  ///< of the grid's step, a power of two
};
constexpr int kStride = sizeof(Vertex);

double farthestReceiver(const LightScene& scene, const scene::LightPlane& plane) {
  double farthest = 0.0;
  for (const auto items : {scene.casters, scene.receivers, scene.shadowlessReceivers}) {
    for (const DrawItem& item : items) {
      for (const glm::dvec3& corner : item.boundsWorld.corners()) {
        farthest = std::max(farthest, plane.fromWorld(corner).z);
      }
    }
  }
  return farthest;
}

/// `sure`: height above all vertices that needs no clipping at any distance from the eye.
std::vector<Vertex> vertexStream(const WedgeVolumes& volumes, double allNear, double sure,
                                 std::span<const double> ends) {
  const outlines::WedgePieces& pieces = volumes.pieces;
  const glm::dvec3 anchor(0, 0, 1);
  const VolumeReach reach{.end = volumes.end(), .sideways = volumes.reach};
  std::vector<Vertex> stream;
  stream.reserve(pieces.pieces.size() * kCorners);
  for (std::size_t p = 0; p < pieces.pieces.size(); ++p) {
    const outlines::WedgePiece& piece = pieces.pieces[p];
    Vertex vertex;
    const double step = volumes.stepsPerUnit * piece.step;
    vertex.stepExponent = static_cast<float>(std::round(std::log2(step)));
    const auto steps = [&](std::size_t i) {
      // Short pieces repeat their last vertex: edges of no length add nothing.
      const std::size_t index = piece.firstVertex + std::min<std::size_t>(i, piece.vertexCount - 1);
      return (pieces.vertices[index] - anchor) / (step * pieces.units);
    };
    const glm::dvec3 center = glm::round(0.5 * (steps(0) + steps(piece.vertexCount / 2)) / kCenterSteps);
    vertex.center = center;
    for (std::size_t i = 0; i < outlines::kPieceVertices; ++i) {
      const glm::vec3 relative(steps(i) - kCenterSteps * center);
      vertex.a[i] = relative.x, vertex.b[i] = relative.y, vertex.h[i] = relative.z;
    }
    const double nearest = piece.extent.nearest;
    const double end = ends.empty() ? reach.end : std::min(kBeyondReceiver * ends[p], reach.end);
    if (end <= nearest) {
      // No receiver: a volume without sides.
      vertex.corner = glm::dvec3(piece.extent.low(nearest), nearest) - anchor;
      stream.insert(stream.end(), kCorners, vertex);
      continue;
    }
    const double first = std::min(piece.extent.farthest + allNear * piece.size(), end);
    const double last = std::min(piece.extent.farthest + std::max(allNear * piece.size(), sure), end);
    for (const double h : {nearest, last, first, end}) {
      for (const glm::dvec3& corner : volumeCorners(piece.extent, h, reach)) {
        vertex.corner = corner - anchor;
        stream.push_back(vertex);
      }
    }
  }
  return stream;
}

/// Of the volumes' lengths, the share that lies before their ends.
double lengthKept(const WedgeVolumes& volumes, std::span<const double> ends) {
  double kept = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double nearest = volumes.pieces.pieces[i].extent.nearest;
    kept += std::max(ends[i] - nearest, 0.0);
    whole += std::max(volumes.end() - nearest, 0.0);
  }
  return kept / std::max(whole, 1e-300);
}

std::uint64_t keyOf(const LightScene& scene, double farthest, double reach) {
  return combineKeys(combineKeys(scene.contentKey, std::bit_cast<std::uint64_t>(farthest)),
                     std::bit_cast<std::uint64_t>(reach));
}

void addPieces(PlannedPass& pass, const PlannedDraw& draw, const WedgeVolumes& volumes, WedgePart part,
               std::size_t first, std::size_t count) {
  using device::VertexAttribute;
  constexpr VertexAttribute kVectors[] = {VertexAttribute::extra0, VertexAttribute::extra1,
                                          VertexAttribute::extra2, VertexAttribute::extra3,
                                          VertexAttribute::extra4, VertexAttribute::normal};
  while (count > 0) {
    const std::size_t now = std::min(count, kPiecesPerDraw), skipped = part == WedgePart::beyond ? 8 : 0;
    const std::size_t offset = (first * kCorners + skipped) * kStride;
    BufferDraw pieces{
        .indices = volumes.indicesInPlan, .indexType = device::IndexType::uint16, .count = now * kIndices};
    const auto add = [&](VertexAttribute attribute, int components, std::size_t at) {
      pieces.attributes.push_back({.attribute = attribute,
                                   .buffer = volumes.streamInPlan,
                                   .components = components,
                                   .strideBytes = kStride,
                                   .offsetBytes = offset + at});
    };
    add(VertexAttribute::position, 3, 0);
    for (std::size_t i = 0; i < 6; ++i) add(kVectors[i], 4, 12 + 16 * i);
    add(VertexAttribute::texcoord, 4, offsetof(Vertex, center));
    pass.draws.emplace_back(draw).what = std::move(pieces);
    first += now, count -= now;
  }
}
}  // namespace

const WedgeVolumes& WedgeVolumeCache::updatePieces(const LightScene& scene) {
  WedgeVolumes& volumes = volumes_;
  std::vector<scene::Bounds> bounds;
  for (const DrawItem& caster : scene.casters) bounds.push_back(caster.boundsWorld);
  const glm::dvec3 toAnchor = scene::toAnchor(scene.light, bounds);
  const bool highp = scene.capabilities.has(device::Capability::highp);
  const scene::LightPlane plane(
      scene.light, toAnchor, (highp ? kMinHalfLength : kMinHalfLengthWithoutHighp) * glm::length(toAnchor));
  const double farthest = farthestReceiver(scene, plane), reach = sidewaysReach(scene, plane);
  const std::uint64_t key = keyOf(scene, farthest, reach);
  if (volumes.contentKey == key) return volumes;
  volumes.contentKey = 0;
  volumes.plane = plane;
  volumes.farthest = farthest;
  volumes.reach = reach;
  // What a caster covers at all counts once, however often it covers it.
  const scene::LightSilhouettes& single =
      volumes.silhouettes.update(scene.silhouettes, placedCasters(scene), volumes.plane, 0.0, 0.0, kMinHeight,
                                 scene::LayerSplit::outline);
  const scene::LightSilhouettes silhouettes = outlines::takenTogether(single);
  volumes.takenTogether = silhouettes.casters.size() < single.casters.size();
  makeWedgePieces(silhouettes, outlines::wedgeUnits(plane), farthest, volumes.pieces);
  volumes.lightEnclosed =
      std::ranges::any_of(silhouettes.casters, &scene::LightSilhouettes::Caster::enclosesLight);
  volumes.contentKey = key;
  return volumes;
}

void WedgeVolumeCache::addBuffers(const LightScene& scene, PassPlan& plan, const ReceiverDepth& depth,
                                  std::span<const double> ends, std::uint64_t endsKey) {
  WedgeVolumes& volumes = volumes_;
  // A power of two, so that it seldom changes.
  const double farthest = std::exp2(std::ceil(std::log2(depth.farthest)));
  const double sure = kAllNearOfDistance * farthest / glm::length(volumes.plane.toUnitHeight);
  const std::uint64_t key =
      combineKeys(combineKeys(volumes.contentKey, endsKey), std::bit_cast<std::uint64_t>(farthest));
  volumes.trimmed = !ends.empty();
  volumes.small = volumes.trimmed && lengthKept(volumes, ends) < 0.5;
  if (volumes.pieces.pieces.empty()) return;
  if (volumes.streamKey != key) {
    const bool highp = scene.capabilities.has(device::Capability::highp);
    volumes.stepsPerUnit = highp ? 1.0 : kStepsWithoutHighp;
    volumes.stream.bytes =
        streamBytes(vertexStream(volumes, highp ? kAllNear : kAllNearWithoutHighp, sure, ends));
    ++volumes.stream.key;
    volumes.streamKey = key;
  }
  volumes.streamInPlan = plan.addBuffer(volumes.stream);
  volumes.indicesInPlan = volumes.indices.addTo(plan, 2, volumes.pieces.pieces.size(), kCorners);
}

void addWedgeVolumes(PlannedPass& pass, PlannedDraw draw, const WedgeVolumes& volumes,
                     const ReceiverDepth& depth, const View& view, std::span<const CasterRange> casters,
                     WedgePart part) {
  const scene::LightPlane& plane = volumes.plane;
  addReceiverPosition(draw, view, depth, receiverRays(view, depth, plane.axes, plane.unitHeightWorld()));
  draw.uniforms.set("u_clipFromLight", glm::mat4(depth.clipFromWorld * outlines::worldFromAnchor(plane)));
  const glm::dvec3& units = volumes.pieces.units;
  const double sizeUnits = outlines::kGridSteps / volumes.stepsPerUnit;
  draw.uniforms.set("u_pieceGrid", glm::vec4(1.0 / units.x, 1.0 / units.y, 1.0, 1.0 / sizeUnits));
  draw.uniforms.set("u_pieceScale",
                    glm::vec4(units.x / units.y, units.y / sizeUnits,
                              kNearOfDistance * depth.farthest / glm::length(plane.toUnitHeight), 0.0));
  const auto hull = eyeHull(view, plane);
  const VolumeReach reach{.end = volumes.end(), .sideways = volumes.reach};
  const bool small = part == WedgePart::beside || volumes.small;
  if (small) {
    // Few receivers lie in these volumes, and most of the screen behind them: the farther sides reject it.
    draw.state.cull = device::Cull::front;
    draw.state.depth = {.test = device::Compare::gequal};
  }
  const auto flush = [&](bool outside, std::size_t first, std::size_t end) {
    // From outside, the sides that face the eye stand in front of every receiver in the volume; from inside,
    // those that face away stand behind it.
    if (!small) {
      draw.state.cull = outside ? device::Cull::back : device::Cull::front;
      draw.state.depth = {.test = outside ? device::Compare::lequal : device::Compare::gequal};
    }
    if (end > first) addPieces(pass, draw, volumes, part, first, end - first);
  };
  std::size_t first = 0, end = 0;
  bool outside = true;
  for (const CasterRange& range : casters) {
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const outlines::WedgeCaster& caster = volumes.pieces.casters[i];
      const bool casterOutside = eyeOutside(caster.extent, reach, hull);
      if (casterOutside != outside || caster.firstPiece != end) {
        flush(outside, first, end);
        first = caster.firstPiece, outside = casterOutside;
      }
      end = caster.firstPiece + caster.pieceCount;
    }
  }
  flush(outside, first, end);
}

}  // namespace halfshadow::techniques
