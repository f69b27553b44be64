// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/engine_object.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include "scene/convex_hull.hpp"

namespace halfshadow {

void EngineObject::place(const glm::dmat4& worldFromHostNow) {
  worldFromHost = worldFromHostNow;
  worldFromObject = glm::translate(worldFromHost, recenteredBy);
  boundsWorld = scene::transformed(worldFromObject, boundsObject);
  mirrored = glm::determinant(glm::dmat3(worldFromObject)) < 0;
  pointsPlaced_ = false;
}

void EngineObject::positionsChanged() {
  animated = true;
  geometry.positionsChanged();
  supportingPlanes_.reset();
  pointsObject_.clear();
  pointsPlaced_ = false;
}

const scene::SupportingPlanes& EngineObject::support() const {
  if (!supportingPlanes_) supportingPlanes_ = scene::supportingPlanesOf(mesh, recenteredBy);
  return *supportingPlanes_;
}

void EngineObject::placePoints() const {
  if (pointsPlaced_) return;
  // A hull costs more than it saves where the next frame has other positions.
  if (pointsObject_.empty())
    pointsObject_ = animated ? scene::usedVertices(mesh) : scene::enclosingPoints(mesh);
  pointsWorld_.clear();
  pointBoundsWorld_ = {};
  for (const glm::dvec3& point : pointsObject_) {
    pointsWorld_.push_back(glm::dvec3(worldFromObject * glm::dvec4(point, 1.0)));
    pointBoundsWorld_.include(pointsWorld_.back());
  }
  pointsPlaced_ = true;
}

planner::CasterShape EngineObject::shape() const {
  placePoints();
  return {.id = id,
          .revision = revision,
          .pointsWorld = pointsWorld_,
          .boundsWorld = pointBoundsWorld_,
          .mesh = &mesh,
          .worldFromObject = &worldFromObject};
}

}  // namespace halfshadow
