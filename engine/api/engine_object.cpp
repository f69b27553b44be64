// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/engine_object.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace halfshadow {

Status EngineObject::uploadTextures(gl::Context& context) {
  for (const auto& image : {baseColorImage, alphaMask}) {
    if (image == nullptr) continue;
    if (Status s = image->upload(context); !s) return s;
  }
  return {};
}

void EngineObject::forgetUploads() {
  mesh->forgetUpload();
  for (const auto& image : {baseColorImage, alphaMask}) {
    if (image != nullptr) image->forgetUpload();
  }
  cutReceiver = {};
}

void EngineObject::place(const glm::dmat4& worldFromHostNow) {
  worldFromHost = worldFromHostNow;
  worldFromObject = glm::translate(worldFromHost, mesh->recenteredBy());
  boundsWorld = scene::transformed(worldFromObject, mesh->bounds());
  mirrored = glm::determinant(glm::dmat3(worldFromObject)) < 0;
  pointsPlaced_ = false;
}

void EngineObject::placePoints() const {
  if (pointsPlaced_) return;
  pointsWorld_.clear();
  pointBoundsWorld_ = {};
  for (const glm::dvec3& point : mesh->enclosing().points) {
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
          .mesh = &mesh->mesh(),
          .worldFromObject = &worldFromObject};
}

}  // namespace halfshadow
