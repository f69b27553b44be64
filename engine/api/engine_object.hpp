// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// An object of the host's: its mesh, where it is, and what follows from both.
#pragma once

#include <optional>
#include <vector>

#include "gl/objects.hpp"
#include "halfshadow/types.hpp"
#include "planner/light_fit.hpp"
#include "scene/bounds.hpp"
#include "scene/convex_hull.hpp"
#include "scene/supporting_planes.hpp"
#include "techniques/execution/gpu_mesh.hpp"

namespace halfshadow {

/// A receiver of which a camera sees so little that only that is drawn (see scene::cutToView).
struct CutReceiver {
  std::uint64_t key = 0;  ///< of the object and the view; 0 = not asked for yet
  bool needed = false;
  scene::TriangleMesh mesh;
  techniques::GpuMesh gpu;
};

struct EngineObject {
  ObjectId id = 0;
  scene::TriangleMesh mesh;  ///< recentred; kept for bounds, tight light fits and silhouettes
  scene::CasterGeometry geometry;
  techniques::GpuMesh gpu;
  glm::dmat4 worldFromHost{1.0};    ///< as the host placed the positions that it gave
  glm::dvec3 recenteredBy{0.0};     ///< what was taken off those
  glm::dmat4 worldFromObject{1.0};  ///< of the recentred positions
  scene::Bounds boundsObject, boundsWorld;
  bool mirrored = false;
  float solidity = 1.0f;  ///< of a caster, see scene::solidity(); of the first positions
  bool casts = true, receives = true;
  glm::vec4 baseColor{1.0f};
  gl::Texture baseColorTexture;
  std::uint64_t revision = 0;
  bool animated = false;            ///< its positions were replaced, and may be again
  mutable CutReceiver cutReceiver;  ///< of the last frame

  /// Sets worldFromObject and what follows from it; recenteredBy and boundsObject are set before.
  void place(const glm::dmat4& worldFromHostNow);
  /// The positions are others now.
  void positionsChanged();
  /// Of the positions there are now; found on the first call.
  const scene::SupportingPlanes& support() const;
  /// Hold its mesh; found once for it.
  const scene::EnclosingPoints& enclosing() const;
  /// For fits; its points are found once for a mesh, and placed when it has moved.
  planner::CasterShape shape() const;

 private:
  void placePoints() const;
  mutable std::optional<scene::SupportingPlanes> supportingPlanes_;  ///< see support()
  mutable scene::EnclosingPoints enclosing_;
  mutable std::vector<glm::dvec3> pointsWorld_;  ///< see shape()
  mutable scene::Bounds pointBoundsWorld_;
  mutable bool pointsPlaced_ = false;
};

}  // namespace halfshadow
