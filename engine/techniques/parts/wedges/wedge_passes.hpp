// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Passes over penumbra wedges on the screen, as several techniques need them.
#pragma once

#include "techniques/parts/lists/screen_walk.hpp"
#include "techniques/parts/wedges/wedge_volumes.hpp"

namespace halfshadow::techniques {

/// Steps of full coverage. Sums over all casters hold up to 8 full coverings, those of one caster 4, each
/// way; a piece is rounded to a step.
inline constexpr float kStepsOfAll = 512.0f, kStepsOfOne = 1024.0f;

inline constexpr device::BlendState kAdd{
    .enabled = true, .source = device::BlendFactor::one, .destination = device::BlendFactor::one};
inline constexpr device::BlendState kMultiply{
    .enabled = true, .source = device::BlendFactor::zero, .destination = device::BlendFactor::srcColor};

/// What the passes of one light share.
struct Wedges {
  const WedgeVolumes* volumes = nullptr;
  ReceiverDepth depth;
};
/// Of programs that draw WedgePart::beside.
void addClipDefines(const LightScene& scene, std::vector<std::string>& defines);
/// Adds both parts of the casters' volumes, drawn by wedge_piece.frag: `steps` of full coverage, blended.
void addVolumes(const LightScene& scene, PassPlan& plan, PlannedPass& pass, const Wedges& wedges,
                std::vector<std::string> defines, std::span<const CasterRange> casters,
                const device::BlendState& blend, float steps);

/// A colour image of the screen's size, under the light's name.
framegraph::ResourceId screenImage(const LightScene& scene, PassPlan& plan, const std::string& name);
/// `color` cleared to or kept as `initial`, with the receivers' depth test.
std::vector<framegraph::Attachment> wedgeTargets(framegraph::ResourceId color, const ReceiverDepth& depth,
                                                 framegraph::InitialContent initial, float clear);
/// Visibility from sums (`steps` > 0) or from an image of visibilities (0).
ReceiverShading screenShading(const LightScene& scene, framegraph::ResourceId image, float steps);
/// Visibility from the covered shares of the light's four quadrants.
ReceiverShading shareShading(const LightScene& scene, framegraph::ResourceId image);
/// How casting receivers of such a shading walk lists on the screen: as its own file does on surfaces.
ScreenWalk ownWalk(const ReceiverShading& shading);

}  // namespace halfshadow::techniques
