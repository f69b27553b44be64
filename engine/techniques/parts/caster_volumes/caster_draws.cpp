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
  glm::vec2 stage;  ///< receivers with an i of no more than x, and more than y
};

double farthestReceiver(const LightScene& scene, const LightLoops& loops) {
  const scene::LightPlane& plane = loops.plane();
  double farthest = loops.minHeight();
  for (const DrawItem& item : scene.receivers) {
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
                  .sides = glm::vec4(glm::dvec4(low, high)),
                  .stage = glm::vec2(volume.fromI, volume.untilI)};
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

Status CasterDraws::update(const LightScene& scene, PassPlan& plan, LightLoops& loops,
                           std::span<const outlines::SubLight> subLights, Batching batching) {
  loops.update(scene, plan, subLights);
  loops_ = &loops;
  const bool changed = loopsSeen_ != loops.generation();
  loopsSeen_ = loops.generation();
  const scene::LightPlane& plane = loops_->plane();
  const VolumeReach reach{.end = farthestReceiver(scene, loops), .sideways = sidewaysReach(scene, plane)};
  if (!encoded_ || changed || reach.end != reach_.end || reach.sideways != reach_.sideways) {
    encoded_ = false;
    reach_ = reach;
    subLights_.assign(subLights.begin(), subLights.end());
    volumes_ = casterVolumes(loops_->subLights(), loops_->space(), reach, batching);
    if (Status s = encode(scene); !s) return s;
    encoded_ = true;
  }
  place_ = listPlace(scene, loops_->minHeight());
  if (volumes_.volumes.empty()) return {};
  recordsInPlan_ = addList(plan, "caster records", records_, vertices_.key);
  verticesInPlan_ = plan.addBuffer(vertices_);
  indicesInPlan_ = indices_.addTo(plan, 2, volumes_.volumes.size(), kCorners);
  return {};
}

Status CasterDraws::encode(const LightScene& scene) {
  if (volumes_.volumes.empty()) return {};
  const auto heads = static_cast<int>(volumes_.lists.tiles.size());
  const ReceiverLists all{&volumes_.lists, std::min(heads, kHeadColumns),
                          (heads + kHeadColumns - 1) / kHeadColumns};
  EncodedLists encoded;
  if (!encodeLists({&all, 1}, std::min(scene.capabilities.limits.textureSize, 65536), encoded)) {
    return Error{
        ErrorCode::outOfMemory,
        "the silhouettes' vertices exceed this device's largest texture; use fewer or simpler casters"};
  }
  vertices_.bytes = streamBytes(vertexStream(volumes_, reach_, loops_->space(), encoded));
  vertices_.key = ++encodings_;
  records_ = std::move(encoded.records);
  return {};
}

void CasterDraws::addDraws(const LightScene& scene, PassPlan& plan, PlannedPass& pass,
                           const ReceiverDepth& depth, const Request& request) const {
  const auto wanted = [&](WedgePart part) {
    return std::ranges::any_of(volumes_.volumes, [&](const CasterVolume& volume) {
      return volume.subLight == request.subLight && volume.batch == request.batch && volume.part == part;
    });
  };
  const scene::LightPlane& plane = loops_->plane();
  const glm::dmat4 worldFromLight(glm::dvec4(plane.halfU, 0), glm::dvec4(plane.halfV, 0),
                                  glm::dvec4(plane.heightUnit * plane.normal, 0),
                                  glm::dvec4(plane.centerWorld, 1));
  const outlines::SubLight& light = subLights_[request.subLight];
  const outlines::ListSpace& space = loops_->space();
  const CasterPlace place = casterPlace(space);
  ReceiverRays rays = receiverRays(scene.screen, depth, place.fromWorld, plane.centerWorld);
  if (space.originI > 0.0) rays.eye.z += 1.0;
  const glm::dmat4 clipFromLight =
      depth.clipFromWorld * worldFromLight * glm::translate(glm::dmat4(1.0), baseOf(space));
  const glm::vec2 texel = 1.0f / glm::vec2(records_.width, records_.height);
  std::vector<std::string> defines = request.defines;
  for (const WedgePart part : {WedgePart::beyond, WedgePart::beside}) {
    if (part == WedgePart::beside) defines.push_back("HS_CASTING_RECEIVER");
    if (part == WedgePart::beside && volumes_.lists.sides) defines.push_back("HS_SIDES");
    if (!wanted(part)) continue;
    PlannedDraw draw{.program = plan.addProgram({"list/caster_volume.vert", request.fragmentFile, defines})};
    addReceiverPosition(draw, scene.screen, depth, rays);
    draw.textures.push_back({.sampler = "u_cellLists", .own = recordsInPlan_});
    draw.textures.insert(draw.textures.end(), request.textures.begin(), request.textures.end());
    draw.uniforms.set("u_clipFromLight", glm::mat4(clipFromLight));
    draw.uniforms.set("u_cellTexel", glm::vec4(0.0f, 0.0f, texel));
    draw.uniforms.set("u_listPlace", place_);
    draw.uniforms.set("u_casterPlace", place.heights);
    draw.uniforms.set("u_facetLift", glm::mat3(place.fromWorld));
    draw.uniforms.set("u_liftSize", place.sizeWorld);
    draw.uniforms.set("u_lightUnit", place.unitWorld);
    draw.uniforms.set("u_casterLight", glm::vec4(light.center - light.half, light.center + light.half));
    draw.state.blend = request.blend;
    draw.state.colorMask = request.colorMask;
    addPart(pass, draw, scene.screen, request, part);
  }
}

void CasterDraws::addPart(PlannedPass& pass, const PlannedDraw& draw, const View& view,
                          const Request& request, WedgePart part) const {
  const auto hull = eyeHull(view, loops_->plane());
  const auto flush = [&](bool outside, std::size_t first, std::size_t end) {
    // From outside, the sides that face the eye stand in front of every receiver in the volume; from inside,
    // those that face away stand behind it. Few receivers are at a caster's own heights, and most of the
    // screen is behind: there, the farther sides reject it.
    const bool front = outside && part == WedgePart::beyond;
    while (first < end) {
      const std::size_t now = std::min(end - first, volumesPerDraw(kCorners));
      const std::size_t offset = first * kCorners * sizeof(Vertex);
      constexpr int kStride = sizeof(Vertex);
      const auto attribute = [&](device::VertexAttribute which, int components, std::size_t at) {
        return BufferDraw::Attribute{.attribute = which,
                                     .buffer = verticesInPlan_,
                                     .components = components,
                                     .strideBytes = kStride,
                                     .offsetBytes = offset + at};
      };
      PlannedDraw& added = pass.draws.emplace_back(draw);
      added.state.cull = front ? device::Cull::back : device::Cull::front;
      added.state.depth = {.test = front ? device::Compare::lequal : device::Compare::gequal};
      added.what =
          BufferDraw{.attributes = {attribute(device::VertexAttribute::position, 3, 0),
                                    attribute(device::VertexAttribute::extra0, 3, offsetof(Vertex, list)),
                                    attribute(device::VertexAttribute::extra1, 4, offsetof(Vertex, sides)),
                                    attribute(device::VertexAttribute::extra2, 2, offsetof(Vertex, stage))},
                     .indices = indicesInPlan_,
                     .indexType = device::IndexType::uint16,
                     .count = now * kVolumeIndices};
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
