// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The engine's objects as the planner sees them, brought up to date with what changed.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "api/engine_object.hpp"
#include "planner/frame_planner.hpp"

namespace halfshadow::api {

class SceneLists {
 public:
  /// An object was added or removed.
  void listChanged() { listed_ = false; }
  void objectChanged(const EngineObject& object) { changed_.push_back(object.id); }
  void update(const std::map<ObjectId, EngineObject>& objects);

  // By index, in the order of ids.
  const EngineObject& object(std::size_t index) const { return *objects_[index]; }
  std::span<const EngineObject* const> objects() const { return objects_; }
  std::span<const planner::PlannedObject> planned() const { return planned_; }

 private:
  bool listed_ = false;
  std::vector<ObjectId> changed_;
  std::vector<const EngineObject*> objects_;
  std::vector<planner::PlannedObject> planned_;
};

}  // namespace halfshadow::api
