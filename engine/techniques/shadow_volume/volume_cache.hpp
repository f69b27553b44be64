// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Shadow volumes of one light's casters, made again only when light or caster changed. No GL.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "scene/light_silhouettes.hpp"
#include "techniques/core/pass_plan.hpp"
#include "techniques/shadow_volume/volume_mesh.hpp"

namespace halfshadow::techniques {

/// The volume of one caster. Pieces are drawn chunk by chunk: chunk i is at most layers[i] thick.
class CachedVolume {
 public:
  std::span<const VolumeChunk> chunks() const { return chunks_; }
  /// Adds draws like `draw` of chunks [first, last) of a surface that was made.
  void addDraws(PlannedPass& pass, const PlannedDraw& draw, VolumeSurface surface, std::uint32_t first,
                std::uint32_t last) const;

 private:
  friend class VolumeCache;
  struct Streams {
    PlannedBuffer vertices{.kind = PlannedBuffer::Kind::vertices},
        indices{.kind = PlannedBuffer::Kind::indices};
    device::IndexType indexType = device::IndexType::uint16;
    std::vector<VolumeMesh::Range> ranges;
    bool made = false;
    std::uint32_t verticesInPlan = 0, indicesInPlan = 0;
  };
  static void fill(Streams& streams, const VolumeMesh& mesh);
  std::uint64_t revision_ = 0;
  glm::dvec3 lightWorld_{0.0};
  bool used_ = false;
  std::vector<VolumeChunk> chunks_;
  Streams streams_[2];
};

/// Of one light.
class VolumeCache {
 public:
  /// Its buffers go to the plan, also those of the other surface if that was made for an earlier frame.
  /// `maxLayers`: of each chunk; the same in every call. The reference stays valid until endFrame().
  const CachedVolume& get(PassPlan& plan, const LightScene& scene, const scene::PlacedCaster& caster,
                          VolumeSurface surface, int maxLayers, bool wideIndices);
  /// Drops the volumes that were not asked for since the last call.
  void endFrame();

 private:
  std::unordered_map<std::uint32_t, CachedVolume> volumes_;  ///< by PlacedCaster::object
  std::uint64_t made_ = 0;                                   ///< counts up: keys of buffers
};

}  // namespace halfshadow::techniques
