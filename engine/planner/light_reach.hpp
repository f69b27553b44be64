// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Suns given as far rectangles. Pure data, double precision.
#pragma once

#include <glm/glm.hpp>

#include "scene/bounds.hpp"
#include "scene/light.hpp"

namespace halfshadow::planner {

/// Distance, in half diagonals of the casters' box, at which a farther light is put.
inline constexpr double kLightReach = 16384.0;

/// The same light, or one nearer along its directions from the casters and smaller in proportion, which their
/// receivers cannot tell from it: directions turn by less than 1 / kLightReach over the casters. Beyond,
/// single precision of distances is coarser than the casters: a sun at 10^7 units tells no depths within ten
/// apart. Moves in steps, so that a caster that moves a little does not move the light.
scene::AreaLight lightWithinReach(const scene::AreaLight& light, const scene::Bounds& castersWorld);

}  // namespace halfshadow::planner
