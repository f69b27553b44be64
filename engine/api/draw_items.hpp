// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What techniques see of the engine's objects.
#pragma once

#include "api/item_list.hpp"
#include "api/scene_lists.hpp"
#include "base/error.hpp"
#include "scene/camera.hpp"
#include "techniques/core/light_scene.hpp"

namespace halfshadow::api {

techniques::DrawItem drawItem(const EngineObject& object);

/// What tells what is made from an object alone.
techniques::ItemHistory::Key keyOf(const SceneLists& scene, std::uint32_t index);

/// What objects are drawn as: casters, or receivers that are in no map of casters.
enum class ItemRole { caster, shadowless };
/// Brings the list to these objects.
void updateItems(ItemList& list, const SceneLists& scene, std::span<const std::uint32_t> objects,
                 ItemRole role);

/// The view that receivers are cut to.
struct ReceiverView {
  const techniques::View& screen;
  const scene::Camera& camera;
  std::uint64_t key = 0;  ///< of both
};
ReceiverView receiverView(const techniques::View& screen, const scene::Camera& camera);

/// The same of receivers. One that casts for no light is cut to what the camera sees where its triangles are
/// too wide for the rasteriser; casters keep their vertices, which their shadow volumes share.
class ReceiverItems {
 public:
  /// `castsForSome`, by object: it is among the casters of some light. Errors: outOfMemory.
  Status update(gl::Context& context, const SceneLists& scene, std::span<const std::uint32_t> receivers,
                std::vector<char> castsForSome, const ReceiverView& view);
  std::span<const techniques::DrawItem> values() const { return list_.values(); }

 private:
  ItemList list_;
  std::vector<char> castsForSome_;
  std::vector<ObjectId> cut_;             ///< that may hold a part of themselves
  std::uint64_t viewKey_ = 0, seen_ = 0;  ///< revision of the scene that `cut_` is of
};

}  // namespace halfshadow::api
