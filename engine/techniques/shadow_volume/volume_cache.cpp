// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_volume/volume_cache.hpp"

#include <algorithm>
#include <limits>

namespace halfshadow::techniques {
namespace {
constexpr std::uint32_t kShortIndexVertices = 65536;

template <typename T>
Status refill(gl::Context& context, gl::Buffer& buffer, gl::BufferTarget target,
              const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span<const T>(values));
  if (buffer) return buffer.update(context, bytes);
  auto made = gl::Buffer::create(context, target, bytes, gl::BufferUsage::dynamicDraw);
  if (!made) return made.error();
  buffer = std::move(made).value();
  return {};
}
}  // namespace

Status CasterVolume::upload(gl::Context& context, const VolumeMesh& mesh, Streams& streams) {
  streams.ranges = mesh.ranges;
  streams.made = true;
  if (mesh.indices.empty()) return {};
  if (Status s = refill(context, streams.vertices, gl::BufferTarget::vertex, mesh.vertices); !s) return s;
  if (*std::ranges::max_element(mesh.indices) < kShortIndexVertices) {
    streams.indexType = gl::IndexType::uint16;
    const std::vector<std::uint16_t> narrow(mesh.indices.begin(), mesh.indices.end());
    return refill(context, streams.indices, gl::BufferTarget::index, narrow);
  }
  streams.indexType = gl::IndexType::uint32;
  return refill(context, streams.indices, gl::BufferTarget::index, mesh.indices);
}

void CasterVolume::draw(gl::Encoder& encoder, const gl::DrawState& state, VolumeSurface surface,
                        std::uint32_t first, std::uint32_t last) const {
  const Streams& streams = streams_[static_cast<std::size_t>(surface)];
  const auto& ranges = streams.ranges;
  for (std::size_t i = 0; i < ranges.size();) {
    VolumeMesh::Range joined = ranges[i++];
    if (joined.chunk < first || joined.chunk >= last) continue;
    while (i < ranges.size() && ranges[i].chunk < last && ranges[i].firstVertex == joined.firstVertex) {
      joined.indexCount += ranges[i++].indexCount;
    }
    const gl::AttributeBinding position{
        gl::VertexAttribute::position,       &streams.vertices, 4, gl::AttributeType::float32, 16,
        std::size_t{joined.firstVertex} * 16};
    encoder.draw(state, {.attributes = std::span(&position, 1),
                         .indices = &streams.indices,
                         .indexType = streams.indexType,
                         .first = joined.firstIndex,
                         .count = joined.indexCount});
  }
}

Result<const CasterVolume*> VolumeCache::get(gl::Context& context, int lightIndex,
                                             const glm::dvec3& lightWorld, const scene::PlacedCaster& caster,
                                             VolumeSurface surface, int maxLayers) {
  const scene::HalfEdgeMesh& mesh = *caster.mesh;
  CasterVolume& volume = volumes_[{lightIndex, &mesh}];
  volume.used_ = true;
  if (volume.revision_ != caster.revision || volume.lightWorld_ != lightWorld) {
    const glm::dmat3 linear(caster.worldFromObject);
    const glm::dvec3 lightObject =
        glm::inverse(linear) * (lightWorld - glm::dvec3(caster.worldFromObject[3]));
    scene::extractSilhouette(mesh, lightObject, volume.silhouette_);
    volume.chunks_ = volumeChunks(mesh, volume.silhouette_, lightObject, maxLayers);
    for (CasterVolume::Streams& streams : volume.streams_) streams.made = false;
    volume.revision_ = caster.revision;
    volume.lightWorld_ = lightWorld;
  }
  CasterVolume::Streams& streams = volume.streams_[static_cast<std::size_t>(surface)];
  if (!streams.made) {
    const bool wideIndices = context.capabilities().has(device::Capability::uintIndex);
    const VolumeMesh built =
        buildVolumeMesh(mesh, volume.silhouette_, volume.chunks_, caster.worldFromObject, lightWorld, surface,
                        wideIndices ? std::numeric_limits<std::uint32_t>::max() : kShortIndexVertices);
    if (Status s = volume.upload(context, built, streams); !s) return s.error();
  }
  return &volume;
}

void VolumeCache::endLight(int lightIndex) {
  for (auto entry = volumes_.begin(); entry != volumes_.end();) {
    const bool unused = entry->first.first == lightIndex && !std::exchange(entry->second.used_, false);
    entry = unused ? volumes_.erase(entry) : std::next(entry);
  }
}

}  // namespace halfshadow::techniques
