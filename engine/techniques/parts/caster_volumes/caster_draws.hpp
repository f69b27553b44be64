// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Draws of whole casters against the receivers' depth: one fragment walks one caster's silhouette, so that
/// what a caster covers is complete before it is stored, and targets need neither signs nor sums.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "techniques/parts/caster_volumes/caster_volumes.hpp"
#include "techniques/parts/lists/light_loops.hpp"
#include "techniques/parts/lists/list_textures.hpp"
#include "techniques/parts/screen/receiver_depth.hpp"

namespace halfshadow::techniques {

/// The casters of one light.
class CasterDraws {
 public:
  /// Made anew when light, casters, settings or the receivers' reach changed; buffers and lists go to the
  /// plan. `loops` are updated, too, and must outlive this. Errors: outOfMemory.
  Status update(const LightScene& scene, PassPlan& plan, LightLoops& loops,
                std::span<const outlines::SubLight> subLights, Batching batching);
  bool lightEnclosed(std::uint32_t subLight) const { return volumes_.lightEnclosed[subLight]; }
  std::uint32_t batchCount() const { return volumes_.batchCount; }

  struct Request {
    std::uint32_t subLight = 0, batch = 0;
    std::string fragmentFile;          ///< includes caster_fragment.glsl
    std::vector<std::string> defines;  ///< of volumes behind their casters
    device::BlendState blend{};
    std::array<bool, 4> colorMask{true, true, true, true};
    std::vector<TextureRead> textures{};  ///< of the fragment shader's own
  };
  /// Into a pass whose depth attachment is ReceiverDepth::depthTest; `depth` was planned with facets.
  void addDraws(const LightScene& scene, PassPlan& plan, PlannedPass& pass, const ReceiverDepth& depth,
                const Request& request) const;

 private:
  Status encode(const LightScene& scene);
  void addPart(PlannedPass& pass, const PlannedDraw& draw, const View& view, const Request& request,
               WedgePart part) const;

  const LightLoops* loops_ = nullptr;  ///< of the last update
  std::uint64_t loopsSeen_ = 0;
  VolumeReach reach_;
  CasterVolumes volumes_;
  bool encoded_ = false;
  ListImage records_;
  PlannedBuffer vertices_{.id = 1};
  VolumeIndices indices_;
  std::uint64_t encodings_ = 0;  ///< counts up: the key of records and vertices
  std::uint32_t recordsInPlan_ = 0, verticesInPlan_ = 0, indicesInPlan_ = 0;
  glm::vec4 place_{0.0f};
  std::vector<outlines::SubLight> subLights_;
};

}  // namespace halfshadow::techniques
