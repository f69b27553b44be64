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

/// The same of receivers; `castsForSome`, by object: it is among the casters of some light. One that casts
/// nothing is cut to what the camera sees where its triangles are too wide for the rasteriser; casters keep
/// their vertices, which their shadow volumes share. `cut`: those that hold a part of themselves, by id,
/// sorted. Errors: outOfMemory.
Status updateReceivers(ItemList& list, gl::Context& context, const SceneLists& scene,
                       std::span<const std::uint32_t> receivers, const std::vector<char>& castsForSome,
                       const ReceiverView& view, std::vector<ObjectId>& cut);

}  // namespace halfshadow::api
