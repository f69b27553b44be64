// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/engine_object.hpp"

#include <glm/gtc/matrix_transform.hpp>

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
  enclosing_ = {};
  pointsPlaced_ = false;
}

const scene::SupportingPlanes& EngineObject::support() const {
  if (!supportingPlanes_) supportingPlanes_ = scene::supportingPlanesOf(mesh, recenteredBy);
  return *supportingPlanes_;
}

const scene::EnclosingPoints& EngineObject::enclosing() const {
  // A hull costs more than it saves where the next frame has other positions.
  if (enclosing_.points.empty())
    enclosing_ =
        animated ? scene::EnclosingPoints{scene::usedVertices(mesh), true} : scene::enclosingPoints(mesh);
  return enclosing_;
}

void EngineObject::placePoints() const {
  if (pointsPlaced_) return;
  pointsWorld_.clear();
  pointBoundsWorld_ = {};
  for (const glm::dvec3& point : enclosing().points) {
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
