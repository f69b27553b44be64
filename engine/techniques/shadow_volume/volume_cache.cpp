// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_volume/volume_cache.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace halfshadow::techniques {
namespace {
constexpr std::uint32_t kShortIndexVertices = 65536;
}  // namespace

void CachedVolume::fill(Streams& streams, const VolumeMesh& mesh) {
  streams.ranges = mesh.ranges;
  streams.made = true;
  streams.vertices.bytes = streamBytes(mesh.vertices);
  const bool narrow = mesh.indices.empty() || *std::ranges::max_element(mesh.indices) < kShortIndexVertices;
  streams.indexType = narrow ? device::IndexType::uint16 : device::IndexType::uint32;
  streams.indices.bytes =
      narrow ? streamBytes(std::vector<std::uint16_t>(mesh.indices.begin(), mesh.indices.end()))
             : streamBytes(mesh.indices);
}

void CachedVolume::addDraws(PlannedPass& pass, const PlannedDraw& draw, VolumeSurface surface,
                            std::uint32_t first, std::uint32_t last) const {
  const Streams& streams = streams_[static_cast<std::size_t>(surface)];
  const auto& ranges = streams.ranges;
  for (std::size_t i = 0; i < ranges.size();) {
    VolumeMesh::Range joined = ranges[i++];
    if (joined.chunk < first || joined.chunk >= last) continue;
    while (i < ranges.size() && ranges[i].chunk < last && ranges[i].firstVertex == joined.firstVertex) {
      joined.indexCount += ranges[i++].indexCount;
    }
    PlannedDraw& added = pass.draws.emplace_back(draw);
    added.what = BufferDraw{.attributes = {{.attribute = device::VertexAttribute::position,
                                            .buffer = streams.verticesInPlan,
                                            .components = 4,
                                            .strideBytes = 16,
                                            .offsetBytes = std::size_t{joined.firstVertex} * 16}},
                            .indices = streams.indicesInPlan,
                            .indexType = streams.indexType,
                            .first = joined.firstIndex,
                            .count = joined.indexCount};
  }
}

const CachedVolume& VolumeCache::get(PassPlan& plan, const LightScene& scene,
                                     const scene::PlacedCaster& caster, VolumeSurface surface, int maxLayers,
                                     bool wideIndices) {
  const scene::HalfEdgeMesh& mesh = *caster.mesh;
  const glm::dvec3& lightWorld = scene.light.centerWorld;
  const scene::LightPoint center{.world = lightWorld};
  CachedVolume& volume = volumes_[caster.object];
  volume.used_ = true;
  if (volume.revision_ != caster.revision || volume.lightWorld_ != lightWorld) {
    volume.chunks_ = volumeChunks(mesh, scene.silhouettes.of(caster, center),
                                  caster.objectFromWorld(lightWorld), maxLayers);
    for (CachedVolume::Streams& streams : volume.streams_) streams.made = false;
    volume.revision_ = caster.revision;
    volume.lightWorld_ = lightWorld;
  }
  CachedVolume::Streams& streams = volume.streams_[static_cast<std::size_t>(surface)];
  if (!streams.made) {
    CachedVolume::fill(streams, buildVolumeMesh(mesh, scene.silhouettes.of(caster, center), volume.chunks_,
                                                caster.worldFromObject, lightWorld, surface,
                                                wideIndices ? std::numeric_limits<std::uint32_t>::max()
                                                            : kShortIndexVertices));
    const std::uint64_t id = (std::uint64_t{caster.object} * 2 + static_cast<std::uint64_t>(surface)) * 2;
    streams.vertices.id = id;
    streams.indices.id = id + 1;
    streams.vertices.key = streams.indices.key = ++made_;
  }
  for (CachedVolume::Streams& held : volume.streams_) {
    if (!held.made) continue;
    held.verticesInPlan = plan.addBuffer(held.vertices);
    held.indicesInPlan = plan.addBuffer(held.indices);
  }
  return volume;
}

void VolumeCache::endFrame() {
  std::erase_if(volumes_, [](const auto& entry) { return !entry.second.used_; });
  for (auto& [object, volume] : volumes_) volume.used_ = false;
}

}  // namespace halfshadow::techniques
