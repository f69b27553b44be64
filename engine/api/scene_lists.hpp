// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The engine's objects as the planner sees them, brought up to date with what changed.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "api/engine_object.hpp"
#include "base/list_changes.hpp"
#include "planner/frame_planner.hpp"

namespace halfshadow::api {

class SceneLists {
 public:
  /// An object was added or removed.
  void listChanged() { listed_ = false; }
  void objectChanged(const EngineObject& object) { changed_.push_back(object.id); }
  void update(const std::map<ObjectId, EngineObject>& objects);
  /// By index.
  ListChanges changes() const { return {revision_, changedPlaces_}; }
  /// What the last update found different; none: the list was another.
  std::optional<std::span<const std::uint32_t>> changed() const {
    if (relisted_) return std::nullopt;
    return changedNow_ ? changedPlaces_ : std::span<const std::uint32_t>{};
  }

  // By index, in the order of ids.
  const EngineObject& object(std::size_t index) const { return *objects_[index]; }
  std::span<const EngineObject* const> objects() const { return objects_; }
  std::span<const planner::PlannedObject> planned() const { return planned_; }
  std::span<const planner::ObjectKey> keys() const { return keys_; }
  bool anyCutOut() const { return anyCutOut_; }  ///< has holes that alpha cuts
  /// Null when there is none of that id.
  const EngineObject* find(ObjectId id) const;

 private:
  bool listed_ = false;
  std::vector<ObjectId> changed_;
  std::vector<const EngineObject*> objects_;
  std::vector<planner::PlannedObject> planned_;
  std::vector<planner::ObjectKey> keys_;
  std::vector<std::uint32_t> changedPlaces_;
  bool relisted_ = true, changedNow_ = false, anyCutOut_ = false;
  std::uint64_t revision_ = 0;
};

}  // namespace halfshadow::api
