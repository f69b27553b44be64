// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Lists of casting receivers, walked on the screen: where triangles are small, a rasteriser runs a walk for
/// every block of pixels that each of them touches, and pixels of its own for few of them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "techniques/core/pass_plan.hpp"
#include "techniques/parts/screen/receiver_depth.hpp"

namespace halfshadow::techniques {

/// What a fragment shader with caster_lists.glsl reads of the lists of a light.
struct ListReads {
  std::vector<std::string> defines;
  std::vector<TextureRead> textures;
  device::UniformList uniforms;
  glm::dmat4 mapFromWorld{1.0};  ///< world -> homogeneous (t, i)
  /// Where the lists of a receiver are.
  std::function<void(const DrawItem&, device::UniformList&)> tilesOf;
};

/// The program that walks them.
struct ScreenWalk {
  std::string fragmentFile;  ///< with own_write.glsl
  std::vector<std::string> defines{};
};

/// The receivers that walk theirs there; nothing where they do so on surfaces: setting list_walk, or what
/// this device or the scene lack. `intoTrees`: lists lead into trees of facets, whose walks are long:
/// measured on llvmpipe, 2 to 3.6 times less time for frames of dense casters (facets of 4 to 200 pixels),
/// where the passes of their own cost frames without trees up to two thirds more.
std::optional<std::vector<NumberedReceiver>> screenWalkers(const LightScene& scene, bool intoTrees);

/// Adds passes that find the visibility of casting receivers on the screen, and makes the plan's shading read
/// it for them.
void planScreenWalk(const LightScene& scene, PassPlan& plan, std::span<const NumberedReceiver> walkers,
                    const ListReads& reads, const ScreenWalk& walk);

}  // namespace halfshadow::techniques
