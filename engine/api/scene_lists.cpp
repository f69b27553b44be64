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
  relisted_ = !listed_;
  changedNow_ = listed_ && !changed_.empty();
  if (!listed_) {
    objects_.clear();
    planned_.clear();
    keys_.clear();
    anyCutOut_ = false;
    for (const auto& [id, object] : objects) {
      objects_.push_back(&object);
      planned_.push_back(plannedObject(object));
      keys_.push_back({id, object.revision});
      anyCutOut_ = anyCutOut_ || object.isCutOut();
    }
    listed_ = true;
    revision_ += 2;
  } else if (changedNow_) {
    changedPlaces_.clear();
    ++revision_;
    for (const ObjectId id : changed_) {
      const auto found = std::ranges::lower_bound(keys_, id, {}, &planner::ObjectKey::id);
      if (found == keys_.end() || found->id != id) continue;
      const auto place = static_cast<std::uint32_t>(found - keys_.begin());
      planned_[place] = plannedObject(*objects_[place]);
      found->revision = planned_[place].revision;
      changedPlaces_.push_back(place);
    }
    std::ranges::sort(changedPlaces_);
    const auto repeated = std::ranges::unique(changedPlaces_);
    changedPlaces_.erase(repeated.begin(), repeated.end());
  }
  changed_.clear();
}

const EngineObject* SceneLists::find(ObjectId id) const {
  const auto found = std::ranges::lower_bound(keys_, id, {}, &planner::ObjectKey::id);
  return found != keys_.end() && found->id == id ? objects_[static_cast<std::size_t>(found - keys_.begin())]
                                                 : nullptr;
}

}  // namespace halfshadow::api
