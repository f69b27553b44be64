// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where the coordinates of a light have their origin, so that single precision holds what the casters' own
/// coordinates hold: beside the caster nearest to the light, be that a lamp shade or a world away from a sun.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "scene/bounds.hpp"
#include "scene/light.hpp"

namespace halfshadow::scene {

/// From the light's centre to a point on its lit side that is about as far as the nearest of the casters: for
/// LightPlane. Farther casters and all receivers are without influence; casters that move by a fraction of
/// their size mostly, too.
/// Where no caster lies at some slope before the light (it is among them, or they stand beside it) the vector
/// is square to the light, at least as long as the light is large.
glm::dvec3 toAnchor(const AreaLight& light, std::span<const Bounds> castersWorld);

}  // namespace halfshadow::scene
