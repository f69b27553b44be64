// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/wedges/wedge_receivers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/keys.hpp"

namespace halfshadow::techniques {
namespace {
/// 7.5 MiB.
constexpr std::size_t kMostFootprintVertices = 65536;
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

std::span<const std::byte> bytesOf(const std::vector<outlines::FootprintVertex>& vertices) {
  return std::as_bytes(std::span(vertices));
}

void drawFootprints(gl::Encoder& encoder, const gl::DrawState& state, const ReceiverDraw& draw) {
  using gl::VertexAttribute;
  constexpr VertexAttribute kVectors[] = {VertexAttribute::extra0, VertexAttribute::extra1,
                                          VertexAttribute::extra2, VertexAttribute::extra3,
                                          VertexAttribute::extra4, VertexAttribute::normal};
  constexpr int kStride = sizeof(outlines::FootprintVertex);
  const std::size_t offset = draw.range.first * kStride;
  const gl::Buffer* buffer = &draw.receiver->footprints;
  gl::AttributeBinding bindings[8];
  bindings[0] = {VertexAttribute::position, buffer, 4, gl::AttributeType::float32, kStride, offset};
  for (std::size_t i = 0; i < 6; ++i) {
    bindings[i + 1] = {kVectors[i], buffer,
                       4,           gl::AttributeType::float32,
                       kStride,     offset + offsetof(outlines::FootprintVertex, x) + 16 * i};
  }
  bindings[7] = {VertexAttribute::texcoord,  buffer,  4,
                 gl::AttributeType::float32, kStride, offset + offsetof(outlines::FootprintVertex, facet)};
  encoder.draw(state, {.attributes = bindings, .count = draw.range.count});
}

void setPiece(gl::Context& context, gl::Program& program, const WedgeVolumes& volumes, std::uint32_t index) {
  const outlines::WedgePiece& piece = volumes.pieces.pieces[index];
  glm::vec4 coordinates[6];
  const glm::dvec3 anchor(0, 0, 1);
  for (std::uint32_t i = 0; i < outlines::kPieceVertices; ++i) {
    const glm::vec3 vertex(volumes.pieces.vertices[piece.firstVertex + std::min(i, piece.vertexCount - 1)] -
                           anchor);
    for (int axis = 0; axis < 3; ++axis)
      coordinates[2 * axis + static_cast<int>(i / 4)][static_cast<int>(i % 4)] = vertex[axis];
  }
  program.setArray(context, "u_piece", coordinates, 6);
  program.set(context, "u_pieceInverseSize", static_cast<float>(1.0 / piece.size()));
}
}  // namespace

Status WedgeReceivers::cut(const LightFrame& frame, const WedgeVolumes& volumes,
                           std::span<const WedgeGroup> groups, const DrawItem& item,
                           WedgeReceiver& receiver) {
  const outlines::ReceiverTriangles triangles(*item.sourceMesh, item.worldFromObject, volumes.plane);
  receiver.bounds = triangles.bounds;
  receiver.vertexCount = item.sourceMesh->positions.size();
  receiver.cut = hasFewTriangles(item);
  receiver.ranges.clear();
  if (!receiver.cut) return {};
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
    return {};
  }
  if (stream.empty()) return {};
  if (receiver.footprints) return receiver.footprints.update(frame.context, bytesOf(stream));
  auto made = gl::Buffer::create(frame.context, gl::BufferTarget::vertex, bytesOf(stream),
                                 gl::BufferUsage::dynamicDraw);
  if (!made) return made.error();
  receiver.footprints = std::move(*made);
  return {};
}

Result<ReceiverDraws> WedgeReceivers::update(const LightFrame& frame, const WedgeVolumes& volumes,
                                             std::span<const WedgeGroup> groups) {
  if (contentKey_ != volumes.contentKey) {
    // Objects that were removed go, too; what the camera does not see now is cut when it does.
    std::erase_if(receivers_, [&](const auto& kept) {
      return std::ranges::none_of(frame.receivers,
                                  [&](const DrawItem& item) { return item.geometry == kept.first; });
    });
    for (auto& [geometry, receiver] : receivers_) receiver.revision = 0;
    contentKey_ = volumes.contentKey;
  }
  for (const DrawItem& item : frame.receivers) {
    WedgeReceiver& receiver = receivers_[item.geometry];
    if (receiver.revision == item.revision) continue;
    receiver.revision = 0;
    if (Status s = cut(frame, volumes, groups, item, receiver); !s) return s.error();
    receiver.revision = item.revision;
  }

  const View& view = frame.screen;
  const glm::dmat4 clipFromLight = view.clipFromWorld * outlines::worldFromLight(volumes.plane);
  ReceiverDraws draws;
  draws.groups.resize(groups.size());
  for (std::size_t i = 0; i < frame.receivers.size(); ++i) {
    const DrawItem& item = frame.receivers[i];
    const WedgeReceiver& receiver = receivers_[item.geometry];
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

VolumeEnds volumeEnds(const LightFrame& frame, const WedgeVolumes& volumes) {
  // Those in view come and go with the camera, but nearly all are casters or cast nothing.
  std::map<const void*, const DrawItem*> dense;
  for (const auto items : {frame.casters, frame.shadowlessReceivers, frame.receivers}) {
    for (const DrawItem& item : items) {
      if (item.receives && !hasFewTriangles(item)) dense[item.geometry] = &item;
    }
  }
  VolumeEnds ends{.heights = std::vector<double>(volumes.pieces.pieces.size(), 0.0), .key = 1};
  for (const auto& [geometry, item] : dense) {
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

Result<ReceiverWedgePrograms> receiverWedgePrograms(const LightFrame& frame,
                                                    const std::vector<std::string>& defines) {
  ReceiverWedgePrograms programs;
  for (const bool cut : {false, true}) {
    for (const bool beyond : {false, true}) {
      std::vector<std::string> variant = defines;
      if (cut) variant.push_back("HS_WEDGE_FOOTPRINT");
      if (cut && snapsCoarsely(frame.capabilities)) variant.push_back("HS_WEDGE_EXACT");
      if (!beyond) variant.push_back("HS_WEDGE_CLIP");
      auto linked = frame.programs.get({"wedge/wedge_receiver.vert", "wedge/wedge_receiver.frag", variant});
      if (!linked) return linked.error();
      programs.byKind[cut][beyond] = *linked;
    }
  }
  return programs;
}

void drawReceiverDepth(framegraph::PassContext& context, gl::Program& program, const View& view,
                       std::span<const DrawItem> items) {
  gl::Encoder& encoder = context.encoder;
  encoder.useProgram(program);
  gl::DrawState state{.depth = {.test = gl::Compare::less, .write = true},
                      .colorMask = {false, false, false, false}};
  for (const DrawItem& item : items) {
    state.cull = hiddenFaces(item, view.eyeWorld, view.nearReach);
    program.set(encoder.context(), "u_clipFromObject", glm::mat4(view.clipFromWorld * item.worldFromObject));
    item.mesh->draw(encoder, state, GpuMesh::Streams::positions);
  }
}

void drawReceiverWedges(framegraph::PassContext& context, const ReceiverWedgePrograms& programs,
                        const WedgeVolumes& volumes, const View& view, const glm::dmat4& clipFromWorld,
                        std::span<const DrawItem> items, std::span<const ReceiverDraw> draws,
                        const gl::BlendState& blend, float steps) {
  gl::Encoder& encoder = context.encoder;
  gl::Context& gl = encoder.context();
  // Subtracted in double: from a far light the places of receivers differ by little.
  const glm::dmat4 anchorFromWorld = glm::inverse(outlines::worldFromAnchor(volumes.plane));
  const ReceiverRays rays = receiverRays(view, {}, volumes.plane.axes, volumes.plane.unitHeightWorld());
  const double least = kNearOfDistance / glm::length(volumes.plane.toUnitHeight);
  gl::Program* current = nullptr;
  for (const ReceiverDraw& draw : draws) {
    const DrawItem& item = items[draw.item];
    gl::Program& program = *programs.byKind[draw.receiver->cut][draw.part == WedgePart::beyond];
    if (&program != current) {
      current = &program;
      encoder.useProgram(program);
      program.set(gl, "u_wedgeSteps", glm::vec4(steps, least, 0, 0));
      program.set(gl, "u_receiverEye", glm::vec4(glm::vec3(rays.eye), 0.0f));
      program.set(gl, "u_receiverRay", glm::vec4(glm::vec3(rays.rayOrigin), 0.0f));
      program.set(gl, "u_receiverRayX", glm::vec4(glm::vec3(rays.rayX), 0.0f));
      program.set(gl, "u_receiverRayY", glm::vec4(glm::vec3(rays.rayY), 0.0f));
    }
    program.set(gl, "u_clipFromObject", glm::mat4(clipFromWorld * item.worldFromObject));
    gl::DrawState state{.depth = {.test = gl::Compare::lequal},
                        .cull = hiddenFaces(item, view.eyeWorld, view.nearReach),
                        .blend = blend};
    program.set(gl, "u_lightFromObject", glm::mat4(anchorFromWorld * item.worldFromObject));
    if (draw.receiver->cut) {
      state.polygonOffset = footprintOffset(gl.capabilities());
      drawFootprints(encoder, state, draw);
    } else {
      setPiece(gl, program, volumes, draw.piece);
      state.polygonOffset = kWholeOffset;
      state.scissor = draw.scissor;
      item.mesh->draw(encoder, state, GpuMesh::Streams::positions);
    }
  }
}

}  // namespace halfshadow::techniques
