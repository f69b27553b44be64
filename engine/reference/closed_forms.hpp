// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Visibilities known on paper, for testing the ray tracer and the techniques.
#pragma once

#include <glm/glm.hpp>

#include "scene/light.hpp"

namespace halfshadow::reference {

/// Share of the light's area that `receiverWorld` sees past an opaque half-plane. The half-plane lies in the
/// plane through `edgePointWorld` parallel to the light; its edge runs through that point along light.halfV
/// and it is opaque on the side of +halfU (negate halfU for the other side: the light's points stay the
/// same). 1 unless that plane is strictly between the receiver and the light's plane. The light has a size.
double halfPlaneVisibility(const scene::AreaLight& light, glm::dvec3 receiverWorld,
                           glm::dvec3 edgePointWorld);

/// The same past an opaque parallelogram parallel to the light:
/// centerWorld + a·lengthU·norm(halfU) + b·lengthV·norm(halfV), a and b in [-1, 1], lengths >= 0 in world
/// units.
double rectangleVisibility(const scene::AreaLight& light, glm::dvec3 receiverWorld, glm::dvec3 centerWorld,
                           double lengthU, double lengthV);

}  // namespace halfshadow::reference
