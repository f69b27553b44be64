// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/caster_volumes/caster_draws.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>

#include "techniques/parts/lists/light_lists.hpp"

namespace halfshadow::techniques {
namespace {
constexpr int kCorners = 8;
/// Lists side by side in the image of their heads, which only the encoder reads here.
constexpr int kHeadColumns = 1024;
/// Volumes end a little behind the farthest receiver, so that it lies inside whatever rounding does.
constexpr double kBehindAll = 1.01;

struct Vertex {
  glm::vec3 corner;
  glm::vec3 list;   ///< column, row, split in steps
  glm::vec4 sides;  ///< low a and b, high a and b over height
};

double farthestReceiver(const LightFrame& frame, const LightLoops& loops) {
  const scene::LightPlane& plane = loops.plane();
  double farthest = loops.minHeight();
  for (const DrawItem& item : frame.receivers) {
    for (const glm::dvec3& corner : item.boundsWorld.corners()) {
      farthest = std::max(farthest, plane.fromWorld(corner).z);
    }
  }
  return kBehindAll * farthest;
}

/// Corners are kept about this point of (a, b, h).
glm::dvec3 baseOf(const outlines::ListSpace& space) {
  return space.originI > 0.0 ? space.lightPoint(glm::dvec3(0.0)) : glm::dvec3(0.0);
}

std::vector<Vertex> vertexStream(const CasterVolumes& volumes, const VolumeReach& reach,
                                 const outlines::ListSpace& space, const EncodedLists& encoded) {
  const glm::dvec3 base = baseOf(space);
  std::vector<Vertex> stream;
  stream.reserve(volumes.volumes.size() * kCorners);
  for (const CasterVolume& volume : volumes.volumes) {
    const EncodedLists::Placed& placed = encoded.lists[volume.list];
    const std::uint32_t record = placed.firstRecord;
    const outlines::WedgeExtent& extent = volume.extent;
    const glm::dvec2 low =
        glm::dvec2(extent.lowA, extent.lowB) - space.originT + space.originI * extent.lightHigh;
    const glm::dvec2 high =
        glm::dvec2(extent.highA, extent.highB) - space.originT + space.originI * extent.lightLow;
    Vertex vertex{.corner = {},
                  .list = glm::vec3(record % kRecordsPerRow, record / kRecordsPerRow,
                                    std::round((volume.splitI - placed.center.z) / placed.step.z)),
                  .sides = glm::vec4(glm::dvec4(low, high))};
    for (const double h : {volume.from, volume.end}) {
      for (const glm::dvec3& corner : volumeCorners(extent, h, reach)) {
        vertex.corner = corner - base;
        stream.push_back(vertex);
      }
    }
  }
  return stream;
}

/// A receiver's place as caster_fragment.glsl has it.
struct CasterPlace {
  glm::dmat3 fromWorld{1.0};  ///< relative to the light's centre; last, 1 less where heights are about equal
  glm::vec4 heights{0.0f}, sizeWorld{0.0f};
  float unitWorld = 1.0f;  ///< by which heights are counted
};
CasterPlace casterPlace(const outlines::ListSpace& space) {
  /// Of 24 bits for a distance five are its exponent.
  constexpr float kDistanceRounding = 1.0f / (1 << 19);
  const glm::dmat4 rows = space.homogeneousFromWorld();
  const bool even = space.originI > 0.0;
  CasterPlace place;
  for (int column = 0; column < 3; ++column)
    place.fromWorld[column] = {rows[column].x, rows[column].y, even ? rows[column].z : rows[column].w};
  const double inverse = even ? 1.0 / space.originI : 1.0;
  place.heights = even ? glm::vec4(inverse, -inverse, 0.0f, 1.0f) : glm::vec4(0.0f, 1.0f, 1.0f, 0.0f);
  const glm::dvec2 half(glm::length(space.plane.halfU), glm::length(space.plane.halfV));
  const double unit = space.plane.heightUnit + glm::dot(glm::abs(space.originT), half);
  place.sizeWorld = glm::vec4(glm::dvec4(half, inverse * unit, kDistanceRounding));
  place.unitWorld = static_cast<float>(unit);
  return place;
}
}  // namespace

Result<CasterPrograms> casterPrograms(const LightFrame& frame, const std::string& fragmentFile,
                                      std::vector<std::string> defines) {
  CasterPrograms programs;
  for (gl::Program** program : {&programs.beyond, &programs.beside}) {
    auto linked = frame.programs.get({"list/caster_volume.vert", fragmentFile, defines});
    if (!linked) return linked.error();
    *program = *linked;
    defines.push_back("HS_CASTING_RECEIVER");
  }
  return programs;
}

Status CasterDraws::update(const LightFrame& frame, std::span<const outlines::SubLight> subLights,
                           Batching batching) {
  const bool changed = loops_.update(frame, subLights);
  const scene::LightPlane& plane = loops_.plane();
  const VolumeReach reach{.end = farthestReceiver(frame, loops_), .sideways = sidewaysReach(frame, plane)};
  if (uploaded_ && !changed && reach.end == reach_.end && reach.sideways == reach_.sideways) return {};
  uploaded_ = false;
  reach_ = reach;
  subLights_.assign(subLights.begin(), subLights.end());
  volumes_ = casterVolumes(loops_.subLights(), loops_.space(), reach, batching);
  if (Status s = upload(frame); !s) return s;
  uploaded_ = true;
  return {};
}

Status CasterDraws::upload(const LightFrame& frame) {
  if (volumes_.volumes.empty()) return {};
  const auto heads = static_cast<int>(volumes_.lists.tiles.size());
  const ReceiverLists all{&volumes_.lists, std::min(heads, kHeadColumns),
                          (heads + kHeadColumns - 1) / kHeadColumns};
  EncodedLists encoded;
  if (!encodeLists({&all, 1}, std::min(frame.capabilities.limits.textureSize, 65536), encoded)) {
    return Error{
        ErrorCode::outOfMemory,
        "the silhouettes' vertices exceed this device's largest texture; use fewer or simpler casters"};
  }
  place_ = listPlace(frame, loops_.minHeight());
  if (Status s = uploadList(frame.context, encoded.records, records_); !s) return s;
  const std::vector<Vertex> stream = vertexStream(volumes_, reach_, loops_.space(), encoded);
  if (Status s =
          uploadVolumes(frame.context, vertices_, gl::BufferTarget::vertex, std::as_bytes(std::span(stream)));
      !s) {
    return s;
  }
  return uploadVolumeIndices(frame.context, indices_, volumes_.volumes.size(), kCorners);
}

void CasterDraws::draw(framegraph::PassContext& context, const CasterPrograms& programs,
                       const ReceiverDepth& depth, const View& view, const Request& request) const {
  const auto wanted = [&](WedgePart part) {
    return std::ranges::any_of(volumes_.volumes, [&](const CasterVolume& volume) {
      return volume.subLight == request.subLight && volume.batch == request.batch && volume.part == part;
    });
  };
  gl::Encoder& encoder = context.encoder;
  gl::Context& gl = encoder.context();
  const scene::LightPlane& plane = loops_.plane();
  const glm::dmat4 worldFromLight(glm::dvec4(plane.halfU, 0), glm::dvec4(plane.halfV, 0),
                                  glm::dvec4(plane.heightUnit * plane.normal, 0),
                                  glm::dvec4(plane.centerWorld, 1));
  const outlines::SubLight& light = subLights_[request.subLight];
  const outlines::ListSpace& space = loops_.space();
  const CasterPlace place = casterPlace(space);
  ReceiverRays rays = receiverRays(view, depth, place.fromWorld, plane.centerWorld);
  if (space.originI > 0.0) rays.eye.z += 1.0;
  const glm::dmat4 clipFromLight =
      depth.clipFromWorld * worldFromLight * glm::translate(glm::dmat4(1.0), baseOf(space));
  const glm::vec2 texel = 1.0f / glm::vec2(records_.desc().width, records_.desc().height);
  for (const WedgePart part : {WedgePart::beyond, WedgePart::beside}) {
    if (!wanted(part)) continue;
    gl::Program& program = part == WedgePart::beyond ? *programs.beyond : *programs.beside;
    encoder.useProgram(program);
    bindReceiverPosition(context, program, depth, rays);
    const gl::TextureBinding binding{program.samplerUnit("u_cellLists"), &records_};
    encoder.bindTextures({&binding, 1});
    program.set(gl, "u_clipFromLight", glm::mat4(clipFromLight));
    program.set(gl, "u_cellTexel", glm::vec4(0.0f, 0.0f, texel));
    program.set(gl, "u_listPlace", place_);
    program.set(gl, "u_casterPlace", place.heights);
    program.set(gl, "u_facetLift", glm::mat3(place.fromWorld));
    program.set(gl, "u_liftSize", place.sizeWorld);
    program.set(gl, "u_lightUnit", place.unitWorld);
    program.set(gl, "u_casterLight", glm::vec4(light.center - light.half, light.center + light.half));
    if (request.prepare) request.prepare(program);
    drawPart(encoder, view, request, part);
  }
}

void CasterDraws::drawPart(gl::Encoder& encoder, const View& view, const Request& request,
                           WedgePart part) const {
  const auto hull = eyeHull(view, loops_.plane());
  gl::DrawState state{.blend = request.blend, .colorMask = request.colorMask};
  const auto flush = [&](bool outside, std::size_t first, std::size_t end) {
    // From outside, the sides that face the eye stand in front of every receiver in the volume; from inside,
    // those that face away stand behind it. Few receivers are at a caster's own heights, and most of the
    // screen is behind: there, the farther sides reject it.
    const bool front = outside && part == WedgePart::beyond;
    state.cull = front ? gl::Cull::back : gl::Cull::front;
    state.depth = {.test = front ? gl::Compare::lequal : gl::Compare::gequal};
    while (first < end) {
      const std::size_t now = std::min(end - first, volumesPerDraw(kCorners));
      const std::size_t offset = first * kCorners * sizeof(Vertex);
      constexpr int kStride = sizeof(Vertex);
      const gl::AttributeBinding bindings[] = {
          {gl::VertexAttribute::position, &vertices_, 3, gl::AttributeType::float32, kStride, offset},
          {gl::VertexAttribute::extra0, &vertices_, 3, gl::AttributeType::float32, kStride,
           offset + offsetof(Vertex, list)},
          {gl::VertexAttribute::extra1, &vertices_, 4, gl::AttributeType::float32, kStride,
           offset + offsetof(Vertex, sides)}};
      encoder.draw(state, {.attributes = bindings,
                           .indices = &indices_,
                           .indexType = gl::IndexType::uint16,
                           .count = now * kVolumeIndices});
      first += now;
    }
  };
  std::size_t first = 0, end = 0;
  bool outside = true;
  for (std::size_t i = 0; i < volumes_.volumes.size(); ++i) {
    const CasterVolume& volume = volumes_.volumes[i];
    if (volume.subLight != request.subLight || volume.batch != request.batch || volume.part != part) continue;
    const bool volumeOutside = part == WedgePart::beside || eyeOutside(volume.extent, reach_, hull);
    if (i != end || volumeOutside != outside) {
      flush(outside, first, end);
      first = i, outside = volumeOutside;
    }
    end = i + 1;
  }
  flush(outside, first, end);
}

}  // namespace halfshadow::techniques
