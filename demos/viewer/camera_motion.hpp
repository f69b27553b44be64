// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How a hand moves a camera. Distances are shares of what is seen, so that scenes of any size feel alike.
#pragma once

#include <glm/glm.hpp>

#include "scene/camera.hpp"

namespace halfshadow::viewer {

/// Round the target; `pixels` of a picture `height` pixels high, a quarter of whose height is about 45
/// degrees. Never over the poles.
void orbit(scene::Camera& camera, const glm::dvec2& pixels, double height);
/// Eye and target sideways, so that what is at the target's depth follows the pointer.
void pan(scene::Camera& camera, const glm::dvec2& pixels, double height);
/// Nearer to the target by a tenth a step, or farther away; never through it.
void zoom(scene::Camera& camera, double steps);
/// Eye and target together: x right, y up, z forward, in distances between eye and target.
void fly(scene::Camera& camera, const glm::dvec3& shares);

}  // namespace halfshadow::viewer
