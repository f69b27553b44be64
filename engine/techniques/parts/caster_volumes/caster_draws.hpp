// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Draws of whole casters against the receivers' depth: one fragment walks one caster's silhouette, so that
/// what a caster covers is complete before it is stored, and targets need neither signs nor sums.
#pragma once

#include <map>

#include "techniques/parts/caster_volumes/caster_volumes.hpp"
#include "techniques/parts/lists/light_loops.hpp"
#include "techniques/parts/screen/receiver_depth.hpp"

namespace halfshadow::techniques {

/// Of caster_volume.vert and a fragment shader that includes caster_fragment.glsl.
struct CasterPrograms {
  gl::Program* beside = nullptr;  ///< compiled with HS_CASTING_RECEIVER
  gl::Program* beyond = nullptr;
};
/// Errors: shaderFailed.
Result<CasterPrograms> casterPrograms(const LightFrame& frame, const std::string& fragmentFile,
                                      std::vector<std::string> defines);

/// The casters of one light.
class CasterDraws {
 public:
  /// Made anew when light, casters, settings or the receivers' reach changed. Errors: outOfMemory.
  Status update(const LightFrame& frame, std::span<const outlines::SubLight> subLights, Batching batching);
  bool lightEnclosed(std::uint32_t subLight) const { return volumes_.lightEnclosed[subLight]; }
  std::uint32_t batchCount() const { return volumes_.batchCount; }

  struct Request {
    std::uint32_t subLight = 0, batch = 0;
    gl::BlendState blend;
    std::array<bool, 4> colorMask{true, true, true, true};
    /// Called with each program while it is current: uniforms and textures of the fragment shader's own.
    std::function<void(gl::Program&)> prepare{};
  };
  /// In a pass whose depth attachment is ReceiverDepth::depthTest; `depth` was declared with facets.
  void draw(framegraph::PassContext& context, const CasterPrograms& programs, const ReceiverDepth& depth,
            const View& view, const Request& request) const;

 private:
  Status upload(const LightFrame& frame);
  void drawPart(gl::Encoder& encoder, const View& view, const Request& request, WedgePart part) const;

  LightLoops loops_;
  VolumeReach reach_;
  CasterVolumes volumes_;
  bool uploaded_ = false;
  gl::Texture records_;
  gl::Buffer vertices_, indices_;
  glm::vec4 place_{0.0f};
  std::vector<outlines::SubLight> subLights_;
};

}  // namespace halfshadow::techniques
