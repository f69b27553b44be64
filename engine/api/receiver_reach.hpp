// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// How far behind the casters receivers reach.
#pragma once

#include <cstdint>
#include <span>

#include "base/list_changes.hpp"
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

/// The same, kept: where some objects changed and the fit is as it was, they alone are looked at, unless the
/// farthest is among them.
class ReceiverReach {
 public:
  /// `changes`: of the objects, by index.
  double update(const planner::LightFit& fit, std::span<const planner::PlannedObject> objects,
                const ListChanges& changes);
  double farthest() const { return farthest_; }

 private:
  planner::LightFit fit_;
  std::uint64_t seen_ = 0;  ///< revision of the objects
  double farthest_ = 0.0;
  std::uint32_t farthestId_ = 0;
};

}  // namespace halfshadow::api
