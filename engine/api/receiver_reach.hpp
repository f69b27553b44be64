// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How far behind the casters receivers reach.
#pragma once

#include <span>

#include "planner/frame_planner.hpp"
#include "planner/light_fit.hpp"
#include "scene/bounds.hpp"
#include "scene/mesh.hpp"

namespace halfshadow::api {

/// Largest z in light space of the part of the box that lies inside the fitted view; 0 when none does. With
/// it the widest penumbra of a frame is known before anything is drawn.
double receiverFarDistance(const planner::LightFit& fit, const scene::Bounds& receiverWorld);
/// Of the mesh's triangles, which a turn of the scene does not change: the box of a slanted ground reaches
/// far behind it.
double receiverFarDistance(const planner::LightFit& fit, const scene::TriangleMesh& mesh,
                           const glm::dmat4& worldFromObject);

/// Of all objects that receive: by their triangles where a mesh has few enough, else by its box. Only those
/// are looked at whose boxes reach farther than what was found.
double receiverFarDistance(const planner::LightFit& fit, std::span<const planner::PlannedObject> objects);

}  // namespace halfshadow::api
