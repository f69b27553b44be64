// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/scene_lists.hpp"

#include <algorithm>

namespace halfshadow::api {
namespace {
planner::PlannedObject plannedObject(const EngineObject& object) {
  return {.id = object.id,
          .boundsWorld = object.boundsWorld,
          .revision = object.revision,
          .casts = object.casts,
          .receives = object.receives,
          .mesh = &object.mesh->mesh(),
          .support = &object.mesh->support(),
          .enclosing = &object.mesh->enclosing(),
          .worldFromObject = object.worldFromObject};
}
}  // namespace

void SceneLists::update(const std::map<ObjectId, EngineObject>& objects) {
  if (!listed_) {
    objects_.clear();
    planned_.clear();
    for (const auto& [id, object] : objects) {
      objects_.push_back(&object);
      planned_.push_back(plannedObject(object));
    }
    listed_ = true;
  } else {
    for (const ObjectId id : changed_) {
      const auto found = std::ranges::lower_bound(planned_, id, {}, &planner::PlannedObject::id);
      if (found != planned_.end() && found->id == id)
        *found = plannedObject(*objects_[static_cast<std::size_t>(found - planned_.begin())]);
    }
  }
  changed_.clear();
}

}  // namespace halfshadow::api
