// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/draw_items.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/keys.hpp"
#include "scene/view_cut.hpp"

namespace halfshadow::api {

techniques::DrawItem drawItem(const EngineObject& object) {
  const api::ObjectMesh& mesh = *object.mesh;
  const scene::MeshStatistics& statistics = mesh.mesh().statistics;
  // Through holes its inside is seen.
  const bool closed = !object.isCutOut() && statistics.closed() && statistics.nonManifoldEdges == 0;
  return {.object = object.id,
          .revision = object.revision,
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
          .geometry = &object.geometry()};
}

void updateItems(ItemList& list, const SceneLists& scene, std::span<const std::uint32_t> objects,
                 ItemRole role) {
  list.resize(objects.size());
  for (std::size_t place = 0; place < objects.size(); ++place) {
    const planner::ObjectKey& key = scene.keys()[objects[place]];
    if (list.holds(place, key.id, key.revision)) continue;
    techniques::DrawItem item = drawItem(scene.object(objects[place]));
    item.casts = item.casts && role == ItemRole::caster;
    list.put(place, key.id, key.revision, std::move(item));
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
                       const ReceiverView& view, std::vector<ObjectId>& cut) {
  list.resize(receivers.size());
  const std::vector<ObjectId> cutBefore = std::exchange(cut, {});
  for (std::size_t place = 0; place < receivers.size(); ++place) {
    const std::uint32_t index = receivers[place];
    const planner::ObjectKey& object = scene.keys()[index];
    const bool casts = castsForSome[index] != 0;
    const std::uint64_t key = casts ? object.revision : combineKeys(object.revision, view.key);
    if (!casts) cut.push_back(object.id);
    if (list.holds(place, object.id, key)) continue;
    if (casts) {
      list.put(place, object.id, key, drawItem(scene.object(index)));
      continue;
    }
    auto item = cutItem(context, scene.object(index), view, key);
    if (!item) {
      cut.insert(cut.end(), cutBefore.begin(), cutBefore.end());
      std::ranges::sort(cut);
      return item.error();
    }
    list.put(place, object.id, key, *item);
  }
  std::ranges::sort(cut);
  // Receivers that went out of view, or cast now, keep no part of themselves.
  for (const ObjectId id : cutBefore) {
    if (std::ranges::binary_search(cut, id)) continue;
    if (const EngineObject* object = scene.find(id)) object->cutReceiver = {};
  }
  return {};
}

}  // namespace halfshadow::api
