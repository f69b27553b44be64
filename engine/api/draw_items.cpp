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

techniques::ItemHistory::Key keyOf(const SceneLists& scene, std::uint32_t index) {
  const planner::ObjectKey& key = scene.keys()[index];
  return {key.id, key.revision};
}

void updateItems(ItemList& list, const SceneLists& scene, std::span<const std::uint32_t> objects,
                 ItemRole role) {
  const auto make = [&](std::uint32_t index) -> Result<techniques::DrawItem> {
    techniques::DrawItem item = drawItem(scene.object(index));
    item.casts = item.casts && role == ItemRole::caster;
    return item;
  };
  // Nothing that it makes can fail.
  (void)list.follow(
      objects, scene.changes(), [&](std::uint32_t index) { return keyOf(scene, index); }, make);
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

Status ReceiverItems::update(gl::Context& context, const SceneLists& scene,
                             std::span<const std::uint32_t> receivers, std::vector<char> castsForSome,
                             const ReceiverView& view) {
  const bool alike = castsForSome == castsForSome_ && (cut_.empty() || view.key == viewKey_);
  const bool sameCut = alike && list_.isOf(receivers) && scene.changes().since(seen_);
  seen_ = 0;
  castsForSome_ = std::move(castsForSome);
  const auto keyOfReceiver = [&](std::uint32_t index) {
    techniques::ItemHistory::Key key = keyOf(scene, index);
    if (castsForSome_[index] == 0) key.revision = combineKeys(key.revision, view.key);
    return key;
  };
  const auto make = [&](std::uint32_t index) -> Result<techniques::DrawItem> {
    const EngineObject& object = scene.object(index);
    if (castsForSome_[index] != 0) return drawItem(object);
    return cutItem(context, object, view, keyOfReceiver(index).revision);
  };
  std::vector<ObjectId> before, now;
  if (!sameCut) {
    for (const std::uint32_t index : receivers) {
      if (castsForSome_[index] == 0) now.push_back(scene.keys()[index].id);
    }
    std::ranges::sort(now);
    // Of both until all are made: one that fails leaves the others with their parts.
    before = cut_;
    cut_.insert(cut_.end(), now.begin(), now.end());
  }
  if (Status s = list_.follow(receivers, alike ? scene.changes() : ListChanges{}, keyOfReceiver, make); !s)
    return s;
  if (!sameCut) {
    // Receivers that went out of view, or cast now, keep no part of themselves.
    cut_ = std::move(now);
    for (const ObjectId id : before) {
      if (std::ranges::binary_search(cut_, id)) continue;
      if (const EngineObject* object = scene.find(id)) object->cutReceiver = {};
    }
  }
  viewKey_ = view.key;
  seen_ = scene.changes().revision;
  return {};
}

}  // namespace halfshadow::api
