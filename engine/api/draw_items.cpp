// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/draw_items.hpp"

#include <bit>
#include <cmath>

#include "base/keys.hpp"
#include "scene/view_cut.hpp"

namespace halfshadow::api {

techniques::DrawItem drawItem(const EngineObject& object) {
  return {.object = object.id,
          .mesh = &object.gpu,
          .casts = object.casts,
          .receives = object.receives,
          .worldFromObject = object.worldFromObject,
          .baseColor = object.baseColor,
          .baseColorTexture = object.baseColorTexture ? &object.baseColorTexture : nullptr,
          .boundsWorld = object.boundsWorld,
          .closed = object.mesh.statistics.closed() && object.mesh.statistics.nonManifoldEdges == 0,
          .solidity = object.solidity,
          .mirrored = object.mirrored,
          .facetStream = object.gpu.hasFacetStream(),
          .sourceMesh = &object.mesh,
          .geometry = &object.geometry,
          .revision = object.revision};
}

namespace {
std::uint64_t keyOf(const EngineObject& object, const techniques::View& view) {
  std::uint64_t key = combineKeys(object.revision, static_cast<std::uint64_t>(view.height));
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row)
      key = combineKeys(key, std::bit_cast<std::uint64_t>(view.clipFromWorld[column][row]));
  }
  return key;
}

/// Makes it anew when the object or the view changed.
Status update(gl::Context& context, const EngineObject& object, const techniques::View& view,
              const scene::Camera& camera, std::uint64_t key) {
  CutReceiver& cut = object.cutReceiver;
  if (cut.key == key) return {};
  cut = {.key = key};
  auto mesh = scene::cutToView(object.mesh,
                               {.clipFromObject = view.clipFromWorld * object.worldFromObject,
                                .worldFromObject = object.worldFromObject,
                                .eyeWorld = view.eyeWorld,
                                .nearDistance = camera.nearDistance,
                                .pixelAngle = 2.0 * std::tan(0.5 * camera.verticalFovRadians) / view.height});
  // What lies outside the view is drawn as it is, to no effect.
  if (!mesh || mesh->indices.empty()) return {};
  auto gpu = techniques::GpuMesh::create(context, *mesh);
  if (!gpu) return gpu.error();
  cut.needed = true;
  cut.mesh = std::move(*mesh);
  cut.gpu = std::move(gpu).value();
  return {};
}
}  // namespace

Result<techniques::DrawItem> receiverItem(gl::Context& context, const EngineObject& object, bool castsForSome,
                                          const techniques::View& view, const scene::Camera& camera) {
  techniques::DrawItem item = drawItem(object);
  item.casts = castsForSome;
  if (castsForSome) return item;
  const std::uint64_t key = keyOf(object, view);
  if (Status s = update(context, object, view, camera, key); !s) return s.error();
  const CutReceiver& cut = object.cutReceiver;
  if (!cut.needed) return item;
  item.mesh = &cut.gpu;
  item.facetStream = cut.gpu.hasFacetStream();
  item.sourceMesh = &cut.mesh;
  item.boundsWorld = scene::transformed(object.worldFromObject, scene::boundsOf(cut.mesh));
  item.revision = key;
  return item;
}

}  // namespace halfshadow::api
