// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/caster_lists/light_lists.hpp"

#include <algorithm>
#include <cmath>

namespace halfshadow::techniques {
namespace {
/// Tiles of casters against those of other receivers: their surfaces turn away from the light within a tile,
/// and their own silhouettes pass it. Measured at 27 spheres: half as many vertices a fragment at 1/4, a
/// third less at 1/2, for twice and a half more list building.
constexpr double kCasterTileShare = 0.5;

/// Four times as many tiles have at most this many times the records.
constexpr std::size_t kFinerGrowth = 5;

/// Direction of a pixel's ray in the light's coordinates, from (x, y, 1) with x and y in [0, 1] over the
/// view.
glm::dmat3 pixelRays(const View& view, const scene::LightPlane& plane) {
  const glm::dmat4 worldFromClip = glm::inverse(view.clipFromWorld);
  const auto direction = [&](double x, double y) {
    const glm::dvec4 p = worldFromClip * glm::dvec4(x, y, 0.0, 1.0);
    return plane.axes * (glm::dvec3(p) / p.w - view.eyeWorld);
  };
  const glm::dvec3 corner = direction(-1, -1);
  glm::dmat3 rays(direction(1, -1) - corner, direction(-1, 1) - corner, corner);
  // Only directions matter: at unit scale single precision has them all.
  return rays / std::max(glm::length(corner), 1e-300);
}

}  // namespace

Status uploadList(gl::Context& context, const ListImage& image, gl::Texture& texture) {
  if (texture && texture.desc().width == image.width && texture.desc().height == image.height) {
    texture.update(context, 0, 0, image.width, image.height, image.rgba.data());
    return {};
  }
  auto made = gl::Texture::create(context, {.width = image.width, .height = image.height}, image.rgba.data());
  if (!made) return made.error();
  texture = std::move(made).value();
  return {};
}

Status LightLists::update(const LightFrame& frame, const ListRequest& request) {
  if (loops_.update(frame, request.subLights)) {
    surfaces_ = NearSurfaces(placedCasters(frame), loops_.plane(), LightLoops::kMinHeight);
    shadows_ = shadowedTangents(loops_.subLights());
    receivers_.clear();
    encoded_.clear();
    std::vector<const void*> geometries;
    for (const DrawItem& caster : frame.casters) geometries.push_back(caster.geometry);
    // Whatever stood here before must not show in the picture.
    if (geometries != casters_) doublings_ = 0;
    casters_ = std::move(geometries);
  }
  const glm::dvec2 size = shadows_.high - shadows_.low;
  const double finest = std::max(size.x, size.y) / request.tiles;
  const gl::Limits& limits = frame.capabilities.limits;
  // The column and row of a list take 24 bits; without highp, coordinates of 1024 rows are exact.
  const int maxRows =
      std::min({limits.textureSize, 65536, frame.capabilities.has(gl::Capability::highp) ? 65536 : 1024});
  tileSize_ = finest * std::exp2(doublings_);
  bool changed = !tiles_;
  for (int attempt = 0; attempt < 8; ++attempt) {
    std::vector<const void*> used;
    std::vector<ReceiverLists> receivers;
    for (const DrawItem& item : frame.receivers) {
      if (request.receivers == ListedReceivers::casting && !item.casts) continue;
      Receiver& cached = receivers_[item.geometry];
      if (cached.revision != item.revision) {
        cached.revision = item.revision;
        const ListedReceiver receiver{.ownObject = placedCasterOf(frame, item), .lift = loops_.lift()};
        cached.tiles =
            receiverTiles({.mesh = item.sourceMesh,
                           .worldFromObject = item.worldFromObject,
                           .closed = item.closed,
                           .withPatches = receiver.ownObject != kNoObject},
                          loops_.plane(), shadows_, (item.casts ? kCasterTileShare : 1.0) * tileSize_,
                          kMaxTiles, LightLoops::kMinHeight, loops_.lift());
        cached.lists = cellLists(loops_.subLights(), surfaces_, cached.tiles, receiver, request.edges);
        changed = true;
      }
      used.push_back(item.geometry);
      receivers.push_back({&cached.lists, cached.tiles.columns, cached.tiles.rows});
    }
    // Receivers come in the camera's order; what is encoded does not depend on it.
    std::vector<const void*> inSomeOrder = used;
    std::ranges::sort(inSomeOrder);
    if (!changed && inSomeOrder == encoded_) return {};
    EncodedLists encoded;
    if (encodeLists(receivers, maxRows, encoded)) {
      if (Status s = uploadList(frame.context, encoded.tiles, tiles_); !s) return s;
      if (Status s = uploadList(frame.context, encoded.records, records_); !s) return s;
      center_ = encoded.center;
      step_ = encoded.step;
      for (std::size_t i = 0; i < used.size(); ++i) receivers_[used[i]].firstTexel = encoded.firstTexel[i];
      encoded_ = std::move(inSomeOrder);
      // The next lists are tried finer where these would have fitted.
      if (doublings_ > 0 && encoded.rows * kFinerGrowth < static_cast<std::size_t>(maxRows)) --doublings_;
      return {};
    }
    // Half as many tiles a side: lists grow by less than their number shrinks.
    ++doublings_;
    tileSize_ *= 2.0;
    receivers_.clear();
    frame.graph.noteSkipped(std::string(request.tilesKey),
                            "the lists exceed the largest texture; tiles are twice as large");
  }
  return Error{ErrorCode::outOfMemory,
               "the silhouettes' vertex lists exceed this device's largest texture; lower " +
                   std::string(request.tilesKey)};
}

void LightLists::provide(const LightFrame& frame, ReceiverShading& shading) const {
  shading.forward = false;
  shading.usesFacetPlane = true;
  shading.selfReceivers = ReceiverShading::SelfReceivers::casting;
  const bool oneSided =
      std::ranges::any_of(receivers_, [](const auto& receiver) { return receiver.second.lists.oneSided; });
  if (oneSided) shading.defines.push_back("HS_ONE_SIDED");
  shading.textures.push_back({.sampler = "u_cellTiles", .resource = {}, .texture = &tiles_});
  shading.textures.push_back({.sampler = "u_cellLists", .resource = {}, .texture = &records_});
  // Rows a, b, h, h: what the vertex shader hands on as (a, b, -, h).
  const scene::LightPlane& plane = loops_.plane();
  const glm::dmat3& axes = plane.axes;
  const glm::dvec3 offset = plane.fromWorld(glm::dvec3(0.0));
  for (int column = 0; column < 3; ++column) {
    shading.mapFromWorld[column] = glm::dvec4(axes[column], axes[column].z);
  }
  shading.mapFromWorld[3] = glm::dvec4(offset, offset.z);
  const glm::vec2 tileTexel = 1.0f / glm::vec2(tiles_.desc().width, tiles_.desc().height);
  const glm::vec2 recordTexel = 1.0f / glm::vec2(records_.desc().width, records_.desc().height);
  const glm::mat3 lift(loops_.lift() * loops_.lift() * axes * glm::transpose(axes));
  // Vertices are stored to half a step.
  const auto heightBias = static_cast<float>(2.0 * frame.settings.real("bias")) * step_.z;
  const glm::mat3 rays(pixelRays(frame.view, plane));
  const glm::vec3 eye(plane.fromWorld(frame.view.eyeWorld));
  shading.setUniforms = [others = std::move(shading.setUniforms), lift, rays, eye,
                         center = glm::vec4(center_, LightLoops::kMinHeight),
                         step = glm::vec4(step_, heightBias), texel = glm::vec4(tileTexel, recordTexel)](
                            gl::Program& program, gl::Context& context) {
    if (others) others(program, context);
    program.set(context, "u_cellTexel", texel);
    program.set(context, "u_listCenter", center);
    program.set(context, "u_listScale", step);
    program.set(context, "u_lift", lift);
    program.set(context, "u_rayLight", rays);
    program.set(context, "u_eyeLight", eye);
    // The facet stream's gradient becomes that of i over t.
    program.set(context, "u_vertexPlane", glm::vec4(-1.0f, 1.0f, 1.0f, 1e6f));
  };
  shading.setItemUniforms = [this](gl::Program& program, gl::Context& context, const DrawItem& item) {
    const auto found = receivers_.find(item.geometry);
    if (found == receivers_.end() || found->second.tiles.empty()) {
      program.set(context, "u_tileAtlas", glm::vec4(0.0f));
      return;
    }
    const ReceiverTiles& tiles = found->second.tiles;
    const glm::dvec2 scale = 1.0 / tiles.tileSize;
    program.set(context, "u_tileOfTangent", glm::vec4(glm::dvec4(scale, -tiles.low * scale)));
    program.set(context, "u_tileAtlas",
                glm::vec4(tiles.columns, tiles.rows, found->second.firstTexel.x, found->second.firstTexel.y));
  };
}

}  // namespace halfshadow::techniques
