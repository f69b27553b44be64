// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Shadow volumes on the GPU, one per light and caster, made again only when either changed.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "gl/encoder.hpp"
#include "techniques/execution/light_frame.hpp"
#include "techniques/shadow_volume/volume_mesh.hpp"

namespace halfshadow::techniques {

/// The volume of one caster. Pieces are drawn chunk by chunk: chunk i is at most layers[i] thick.
class CasterVolume {
 public:
  std::span<const VolumeChunk> chunks() const { return chunks_; }
  /// Draws chunks [first, last) of a surface that was made.
  void draw(gl::Encoder& encoder, const gl::DrawState& state, VolumeSurface surface, std::uint32_t first,
            std::uint32_t last) const;

 private:
  friend class VolumeCache;
  struct Streams {
    gl::Buffer vertices, indices;
    gl::IndexType indexType = gl::IndexType::uint16;
    std::vector<VolumeMesh::Range> ranges;
    bool made = false;
  };
  Status upload(gl::Context& context, const VolumeMesh& mesh, Streams& streams);
  std::uint64_t revision_ = 0;
  glm::dvec3 lightWorld_{0.0};
  bool used_ = false;
  scene::Silhouette silhouette_;
  std::vector<VolumeChunk> chunks_;
  Streams streams_[2];
};

/// Of one technique. Buffers of a caster that keeps moving are kept and refilled.
class VolumeCache {
 public:
  /// `maxLayers`: of each chunk; the same in every call. The pointer stays valid until the light's
  /// endLight(). Errors: outOfMemory.
  Result<const CasterVolume*> get(gl::Context& context, int lightIndex, const glm::dvec3& lightWorld,
                                  const scene::PlacedCaster& caster, VolumeSurface surface, int maxLayers);
  /// Drops the light's volumes that were not asked for since the last call.
  void endLight(int lightIndex);
  void clear() { volumes_.clear(); }

 private:
  std::map<std::pair<int, const scene::HalfEdgeMesh*>, CasterVolume> volumes_;
};

}  // namespace halfshadow::techniques
