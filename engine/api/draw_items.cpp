// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/draw_items.hpp"

#include <bit>
#include <cmath>

#include "base/keys.hpp"
#include "scene/view_cut.hpp"

namespace halfshadow::api {

techniques::DrawItem drawItem(const EngineObject& object) {
  const api::ObjectMesh& mesh = *object.mesh;
  const scene::MeshStatistics& statistics = mesh.mesh().statistics;
  // Through holes its inside is seen.
  const bool closed = !object.isCutOut() && statistics.closed() && statistics.nonManifoldEdges == 0;
  return {
      .object = object.id,
      .mesh = &mesh.gpu(),
      .casts = object.casts,
      .receives = object.receives,
      .worldFromObject = object.worldFromObject,
      .baseColor = object.baseColor,
      .baseColorTexture = object.baseColorImage ? &object.baseColorImage->texture() : nullptr,
      .alphaMask = object.isCutOut() ? &object.alphaMask->texture() : nullptr,
      .alphaCutoff = object.alphaCutoff,
      .vertexColors = !mesh.mesh().colors.empty(),
      .boundsWorld = object.boundsWorld,
      .closed = closed,
      .frontOnly = object.singleSided && !closed && mesh.mesh().turned.empty(),
      .solidity = object.casts ? mesh.solidity() : 1.0f,
      .mirrored = object.mirrored,
      .facetStream = mesh.gpu().hasFacetStream(),
      .sourceMesh = &mesh.mesh(),
      .geometry = object.isCutOut() ? &mesh.geometry(object.alphaMask, object.alphaCutoff) : &mesh.geometry(),
      .revision = object.revision};
}

void updateItems(ItemList& list, const SceneLists& scene, std::span<const std::uint32_t> objects,
                 ItemRole role) {
  list.resize(objects.size());
  for (std::size_t place = 0; place < objects.size(); ++place) {
    const planner::PlannedObject& planned = scene.planned()[objects[place]];
    if (list.holds(place, planned.id, planned.revision)) continue;
    techniques::DrawItem item = drawItem(scene.object(objects[place]));
    item.casts = item.casts && role == ItemRole::caster;
    list.put(place, planned.id, planned.revision, std::move(item));
  }
}

ReceiverView receiverView(const techniques::View& screen, const scene::Camera& camera) {
  std::uint64_t key = static_cast<std::uint64_t>(screen.height);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row)
      key = combineKeys(key, std::bit_cast<std::uint64_t>(screen.clipFromWorld[column][row]));
  }
  return {screen, camera, key};
}

namespace {
/// Makes it anew when the object or the view changed.
Status update(gl::Context& context, const EngineObject& object, const ReceiverView& view, std::uint64_t key) {
  CutReceiver& cut = object.cutReceiver;
  if (cut.key == key) return {};
  cut = {};
  auto mesh = scene::cutToView(
      object.mesh->mesh(),
      {.clipFromObject = view.screen.clipFromWorld * object.worldFromObject,
       .worldFromObject = object.worldFromObject,
       .eyeWorld = view.screen.eyeWorld,
       .nearDistance = view.camera.nearDistance,
       .pixelAngle = 2.0 * std::tan(0.5 * view.camera.verticalFovRadians) / view.screen.height});
  // What lies outside the view is drawn as it is, to no effect.
  if (!mesh || mesh->indices.empty()) {
    cut.key = key;
    return {};
  }
  auto gpu = techniques::GpuMesh::create(context, *mesh, object.meshExtras());
  if (!gpu) return gpu.error();
  cut.key = key;
  cut.needed = true;
  cut.mesh = std::move(*mesh);
  cut.gpu = std::move(gpu).value();
  return {};
}

/// That casts for no light.
Result<techniques::DrawItem> cutItem(gl::Context& context, const EngineObject& object,
                                     const ReceiverView& view, std::uint64_t key) {
  techniques::DrawItem item = drawItem(object);
  item.casts = false;
  if (Status s = update(context, object, view, key); !s) return s.error();
  const CutReceiver& cut = object.cutReceiver;
  if (!cut.needed) return item;
  item.mesh = &cut.gpu;
  item.facetStream = cut.gpu.hasFacetStream();
  item.sourceMesh = &cut.mesh;
  item.boundsWorld = scene::transformed(object.worldFromObject, scene::boundsOf(cut.mesh));
  item.revision = key;
  return item;
}
}  // namespace

Status updateReceivers(ItemList& list, gl::Context& context, const SceneLists& scene,
                       std::span<const std::uint32_t> receivers, const std::vector<char>& castsForSome,
                       const ReceiverView& view) {
  list.resize(receivers.size());
  std::vector<std::uint32_t> cutReceivers;
  for (std::size_t place = 0; place < receivers.size(); ++place) {
    const std::uint32_t index = receivers[place];
    const planner::PlannedObject& planned = scene.planned()[index];
    const bool casts = castsForSome[index] != 0;
    const std::uint64_t key = casts ? planned.revision : combineKeys(planned.revision, view.key);
    if (!casts) cutReceivers.push_back(index);
    if (list.holds(place, planned.id, key)) continue;
    if (casts) {
      list.put(place, planned.id, key, drawItem(scene.object(index)));
      continue;
    }
    auto item = cutItem(context, scene.object(index), view, key);
    if (!item) return item.error();
    list.put(place, planned.id, key, *item);
  }
  // Receivers that went out of view, or cast now, keep no part of themselves.
  auto kept = cutReceivers.begin();
  for (std::uint32_t index = 0; index < scene.objects().size(); ++index) {
    if (kept != cutReceivers.end() && *kept == index) {
      ++kept;
    } else if (scene.object(index).cutReceiver.key != 0) {
      scene.object(index).cutReceiver = {};
    }
  }
  return {};
}

}  // namespace halfshadow::api
