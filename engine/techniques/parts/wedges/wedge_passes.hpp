// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Passes over penumbra wedges on the screen, as several techniques need them.
#pragma once

#include "techniques/parts/wedges/wedge_volumes.hpp"

namespace halfshadow::techniques {

/// Steps of full coverage. Sums over all casters hold up to 8 full coverings, those of one caster 4, each
/// way; a piece is rounded to a step.
inline constexpr float kStepsOfAll = 512.0f, kStepsOfOne = 1024.0f;

inline constexpr gl::BlendState kAdd{
    .enabled = true, .source = gl::BlendFactor::one, .destination = gl::BlendFactor::one};
inline constexpr gl::BlendState kMultiply{
    .enabled = true, .source = gl::BlendFactor::zero, .destination = gl::BlendFactor::srcColor};

/// What the passes of one light share.
struct Wedges {
  const WedgeVolumes* volumes = nullptr;
  ReceiverDepth depth;
};
struct PiecePrograms {
  gl::Program* beside = nullptr;
  gl::Program* beyond = nullptr;
};
/// Programs of wedge_piece.frag for both parts. Errors: shaderFailed.
Result<PiecePrograms> piecePrograms(const LightFrame& frame, std::vector<std::string> defines);

/// Draws both parts of the casters' volumes, `steps` of full coverage, blended.
void addVolumes(framegraph::PassContext& context, const PiecePrograms& programs, const Wedges& wedges,
                const View& view, std::span<const CasterRange> casters, const gl::BlendState& blend,
                float steps);

/// "light 0 what"
std::string wedgePassName(const LightFrame& frame, const std::string& what);
/// A colour image of the view's size.
framegraph::ResourceId screenImage(const LightFrame& frame, const std::string& name);
/// `color` cleared to or kept as `initial`, with the receivers' depth test.
std::vector<framegraph::Attachment> wedgeTargets(framegraph::ResourceId color, const ReceiverDepth& depth,
                                                 framegraph::InitialContent initial, float clear);
/// Visibility from sums (`steps` > 0) or from an image of visibilities (0).
ReceiverShading screenShading(const LightFrame& frame, framegraph::ResourceId image, float steps);
/// Visibility from the covered shares of the light's four quadrants.
ReceiverShading shareShading(const LightFrame& frame, framegraph::ResourceId image);

}  // namespace halfshadow::techniques
