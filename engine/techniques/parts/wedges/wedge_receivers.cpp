// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/wedges/wedge_receivers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/keys.hpp"
#include "techniques/parts/wedges/wedge_passes.hpp"

namespace halfshadow::techniques {
namespace {
/// 7.5 MiB.
constexpr std::size_t kMostFootprintVertices = 65536;
/// Ids of buffers, before the receiver's own.
constexpr std::uint64_t kFootprints = std::uint64_t{1} << 32;
/// Volumes are taken a little larger than the receiver, so that it lies inside whatever rounding does.
constexpr double kBeyondReceiver = 1e-3;

/// outlines::Footprints have corners of their own, which rasterisers snap along both axes, those of the
/// visible surface likewise: in all up to four steps of the grid, times the slope.
glm::vec2 footprintOffset(const device::Capabilities& capabilities) {
  return {-std::exp2(2.0f - static_cast<float>(capabilities.limits.subpixelBits)), -2.0f};
}
/// Whole receivers have the same corners as in the depth pass.
constexpr glm::vec2 kWholeOffset(0.0f, -1.0f);

/// Of the rasteriser, for penumbrae of a few pixels.
constexpr int kEnoughSubpixelBits = 6;

void forEachPiece(const WedgeVolumes& volumes, const WedgeGroup& group, auto visit) {
  for (const CasterRange& range : group) {
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const outlines::WedgeCaster& caster = volumes.pieces.casters[i];
      for (std::uint32_t p = 0; p < caster.pieceCount; ++p) visit(caster.firstPiece + p);
    }
  }
}

BufferDraw footprintDraw(const ReceiverDraw& draw, std::uint32_t buffer) {
  using device::VertexAttribute;
  constexpr VertexAttribute kVectors[] = {VertexAttribute::extra0, VertexAttribute::extra1,
                                          VertexAttribute::extra2, VertexAttribute::extra3,
                                          VertexAttribute::extra4, VertexAttribute::normal};
  constexpr int kStride = sizeof(outlines::FootprintVertex);
  BufferDraw footprints{.count = draw.range.count};
  const auto add = [&](VertexAttribute attribute, std::size_t at) {
    footprints.attributes.push_back({.attribute = attribute,
                                     .buffer = buffer,
                                     .components = 4,
                                     .strideBytes = kStride,
                                     .offsetBytes = draw.range.first * kStride + at});
  };
  add(VertexAttribute::position, 0);
  for (std::size_t i = 0; i < 6; ++i) add(kVectors[i], offsetof(outlines::FootprintVertex, x) + 16 * i);
  add(VertexAttribute::texcoord, offsetof(outlines::FootprintVertex, facet));
  return footprints;
}

/// A plan has several passes that draw the same footprints.
std::uint32_t addOnce(PassPlan& plan, const PlannedBuffer& buffer) {
  const auto known = std::ranges::find(plan.buffers, buffer.id, &PlannedBuffer::id);
  return known == plan.buffers.end() ? plan.addBuffer(buffer)
                                     : static_cast<std::uint32_t>(known - plan.buffers.begin());
}

void setPiece(device::UniformList& uniforms, const WedgeVolumes& volumes, std::uint32_t index) {
  const outlines::WedgePiece& piece = volumes.pieces.pieces[index];
  std::vector<glm::vec4> coordinates(6);
  const glm::dvec3 anchor(0, 0, 1);
  for (std::uint32_t i = 0; i < outlines::kPieceVertices; ++i) {
    const glm::vec3 vertex(volumes.pieces.vertices[piece.firstVertex + std::min(i, piece.vertexCount - 1)] -
                           anchor);
    for (std::size_t axis = 0; axis < 3; ++axis)
      coordinates[2 * axis + i / 4][i % 4] = vertex[static_cast<int>(axis)];
  }
  uniforms.set("u_piece", std::move(coordinates));
  uniforms.set("u_pieceInverseSize", static_cast<float>(1.0 / piece.size()));
}
}  // namespace

void WedgeReceivers::cut(const WedgeVolumes& volumes, std::span<const WedgeGroup> groups,
                         const DrawItem& item, WedgeReceiver& receiver) {
  const outlines::ReceiverTriangles triangles(*item.sourceMesh, item.worldFromObject, volumes.plane);
  receiver.bounds = triangles.bounds;
  receiver.vertexCount = item.sourceMesh->positions.size();
  receiver.cut = hasFewTriangles(item);
  receiver.ranges.clear();
  if (!receiver.cut) return;
  std::vector<outlines::FootprintVertex> stream;
  for (const WedgeGroup& group : groups) {
    outlines::Footprints footprints;
    forEachPiece(volumes, group, [&](std::uint32_t piece) {
      if (stream.size() + footprints.vertices() <= kMostFootprintVertices)
        addFootprints(triangles, volumes.pieces, volumes.pieces.pieces[piece], footprints);
    });
    for (const auto* part : {&footprints.beside, &footprints.beyond}) {
      receiver.ranges.push_back({stream.size(), part->size()});
      stream.insert(stream.end(), part->begin(), part->end());
    }
  }
  if (stream.size() > kMostFootprintVertices) {
    receiver.cut = false;
    return;
  }
  receiver.footprints.id = kFootprints + item.object;
  receiver.footprints.bytes = streamBytes(stream);
  ++receiver.footprints.key;
}

ReceiverDraws WedgeReceivers::update(const LightScene& scene, const WedgeVolumes& volumes,
                                     std::span<const WedgeGroup> groups, CastingReceivers casting) {
  const auto isLeftOut = [casting](const DrawItem& item) {
    return casting == CastingReceivers::listed && item.casts && hasFewTriangles(item);
  };
  if (contentKey_ != volumes.contentKey) {
    // Objects that were removed go, too; what the camera does not see now is cut when it does.
    std::erase_if(receivers_, [&](const auto& kept) {
      return std::ranges::none_of(scene.receivers,
                                  [&](const DrawItem& item) { return item.object == kept.first; });
    });
    for (auto& [object, receiver] : receivers_) receiver.revision = 0;
    contentKey_ = volumes.contentKey;
  }
  for (const DrawItem& item : scene.receivers) {
    if (isLeftOut(item)) continue;
    WedgeReceiver& receiver = receivers_[item.object];
    if (receiver.revision == item.revision) continue;
    cut(volumes, groups, item, receiver);
    receiver.revision = item.revision;
  }

  const View& view = scene.screen;
  const glm::dmat4 clipFromLight = view.clipFromWorld * outlines::worldFromLight(volumes.plane);
  ReceiverDraws draws;
  draws.groups.resize(groups.size());
  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    const DrawItem& item = scene.receivers[i];
    if (isLeftOut(item)) continue;
    const WedgeReceiver& receiver = receivers_[item.object];
    if (hasFewTriangles(item) && !receiver.cut) draws.allCut = false;
    const auto corners = item.boundsWorld.corners();
    const auto itemRect = outlines::screenBounds(corners, view.clipFromWorld, view.width, view.height);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<ReceiverDraw>& group = draws.groups[g];
      if (receiver.cut) {
        for (const WedgePart part : {WedgePart::beside, WedgePart::beyond}) {
          const WedgeReceiver::Range& range = receiver.ranges[2 * g + (part == WedgePart::beyond ? 1 : 0)];
          if (range.count > 0) group.push_back({i, part, &receiver, range, 0, {}});
        }
        continue;
      }
      if (!itemRect) continue;
      forEachPiece(volumes, groups[g], [&](std::uint32_t index) {
        const outlines::WedgeExtent& extent = volumes.pieces.pieces[index].extent;
        if (!reaches(extent, receiver.bounds)) return;
        const double margin = kBeyondReceiver * (receiver.bounds.high.z - receiver.bounds.low.z);
        const double from = std::max(extent.nearest, receiver.bounds.low.z - margin);
        const auto volumeRect =
            outlines::screenBounds(outlines::volumeHull(extent, from, receiver.bounds.high.z + margin),
                                   clipFromLight, view.width, view.height);
        const auto rect = volumeRect ? outlines::commonRect(*volumeRect, *itemRect) : std::nullopt;
        if (!rect) return;
        const bool beyond = receiver.bounds.low.z - extent.farthest >=
                            outlines::kAllVerticesNear * volumes.pieces.pieces[index].size();
        group.push_back({i, beyond ? WedgePart::beyond : WedgePart::beside, &receiver, {}, index, *rect});
        ++draws.wholeDraws;
        draws.wholeVertices += receiver.vertexCount;
      });
    }
  }
  for (auto& group : draws.groups) {
    std::ranges::stable_sort(group, {}, [](const ReceiverDraw& draw) {
      return std::pair(draw.receiver->cut, draw.part == WedgePart::beyond);
    });
  }
  return draws;
}

void keepFootprints(ReceiverDraws& draws) {
  for (auto& group : draws.groups)
    std::erase_if(group, [](const ReceiverDraw& draw) { return !draw.receiver->cut; });
  draws.wholeDraws = draws.wholeVertices = 0;
}

VolumeEnds volumeEnds(const LightScene& scene, const WedgeVolumes& volumes) {
  // Those in view come and go with the camera, but nearly all are casters or cast nothing.
  std::map<std::uint64_t, const DrawItem*> dense;
  for (const auto items : {scene.casters, scene.shadowlessReceivers, scene.receivers}) {
    for (const DrawItem& item : items) {
      if (item.receives && !hasFewTriangles(item)) dense[item.object] = &item;
    }
  }
  VolumeEnds ends{.heights = std::vector<double>(volumes.pieces.pieces.size(), 0.0), .key = 1};
  for (const auto& [object, item] : dense) {
    ends.key = combineKeys(ends.key, item->revision);
    outlines::LightBox bounds;
    for (const glm::dvec3& corner : item->boundsWorld.corners())
      bounds.include(volumes.plane.fromWorld(corner));
    for (std::size_t i = 0; i < ends.heights.size(); ++i) {
      if (bounds.high.z > ends.heights[i] && reaches(volumes.pieces.pieces[i].extent, bounds))
        ends.heights[i] = bounds.high.z;
    }
  }
  return ends;
}

bool snapsCoarsely(const device::Capabilities& capabilities) {
  return capabilities.has(device::Capability::highp) &&
         capabilities.limits.subpixelBits < kEnoughSubpixelBits;
}

PlannedDraw receiverSurfaces(const LightScene& scene, PassPlan& plan) {
  PlannedDraw draw{.program =
                       plan.addProgram({"screen/receiver_depth.vert", "screen/receiver_depth.frag", {}})};
  draw.state.depth = {.test = device::Compare::less, .write = true};
  draw.state.colorMask.fill(false);
  draw.what = MeshDraw{.items = scene.receivers,
                       .clipFromWorld = scene.screen.clipFromWorld,
                       .faces = MeshDraw::Faces::facing,
                       .eyeWorld = scene.screen.eyeWorld,
                       .nearReach = scene.screen.nearReach};
  return draw;
}

void addReceiverWedges(const LightScene& scene, PassPlan& plan, PlannedPass& pass,
                       const WedgeVolumes& volumes, std::span<const ReceiverDraw> draws,
                       const ReceiverWedges& how) {
  const View& view = scene.screen;
  // Subtracted in double: from a far light the places of receivers differ by little.
  const glm::dmat4 anchorFromWorld = glm::inverse(outlines::worldFromAnchor(volumes.plane));
  const ReceiverRays rays = receiverRays(view, {}, volumes.plane.axes, volumes.plane.unitHeightWorld());
  const double least = kNearOfDistance / glm::length(volumes.plane.toUnitHeight);
  std::map<std::uint64_t, std::uint32_t> buffers;  // by receiver
  for (const ReceiverDraw& draw : draws) {
    const DrawItem& item = scene.receivers[draw.item];
    const bool cut = draw.receiver->cut;
    std::vector<std::string> defines = how.defines;
    if (cut) defines.push_back("HS_WEDGE_FOOTPRINT");
    if (cut && snapsCoarsely(scene.capabilities)) defines.push_back("HS_WEDGE_EXACT");
    if (draw.part == WedgePart::beside) addClipDefines(scene, defines);
    PlannedDraw planned{.program = plan.addProgram(
                            {"wedge/wedge_receiver.vert", "wedge/wedge_receiver.frag", std::move(defines)})};
    device::UniformList& uniforms = planned.uniforms;
    uniforms.set("u_wedgeSteps", glm::vec4(how.steps, least, 0, 0));
    uniforms.set("u_receiverEye", glm::vec4(glm::vec3(rays.eye), 0.0f));
    uniforms.set("u_receiverRay", glm::vec4(glm::vec3(rays.rayOrigin), 0.0f));
    uniforms.set("u_receiverRayX", glm::vec4(glm::vec3(rays.rayX), 0.0f));
    uniforms.set("u_receiverRayY", glm::vec4(glm::vec3(rays.rayY), 0.0f));
    uniforms.set("u_clipFromObject", glm::mat4(how.clipFromWorld * item.worldFromObject));
    uniforms.set("u_lightFromObject", glm::mat4(anchorFromWorld * item.worldFromObject));
    planned.state.depth = {.test = device::Compare::lequal};
    planned.state.cull = unseenFaces(item, view.eyeWorld, view.nearReach);
    planned.state.blend = how.blend;
    if (cut) {
      const auto [known, added] = buffers.try_emplace(item.object, 0u);
      if (added) known->second = addOnce(plan, draw.receiver->footprints);
      planned.state.polygonOffset = footprintOffset(scene.capabilities);
      planned.what = footprintDraw(draw, known->second);
    } else {
      setPiece(uniforms, volumes, draw.piece);
      planned.state.polygonOffset = kWholeOffset;
      planned.state.scissor = draw.scissor;
      planned.what = MeshDraw{.items = scene.receivers.subspan(draw.item, 1),
                              .clipFromWorld = how.clipFromWorld,
                              .faces = MeshDraw::Faces::facing,
                              .eyeWorld = view.eyeWorld,
                              .nearReach = view.nearReach};
    }
    pass.draws.push_back(std::move(planned));
  }
}

}  // namespace halfshadow::techniques
