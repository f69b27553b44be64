// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/lists/light_lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace halfshadow::techniques {
namespace {
/// Tiles of casters against those of other receivers: their surfaces turn away from the light within a tile,
/// and their own silhouettes pass it. Measured at 27 spheres: half as many vertices a fragment at 1/4, a
/// third less at 1/2, for twice and a half more list building.
constexpr double kCasterTileShare = 0.5;

/// Slope, sideways over height, up to which squeezed tiles are about even, and how many times as far
/// receivers and shadows must reach to have them.
constexpr double kEvenSlope = 2.0, kSqueezedFrom = 16.0;

/// Four times as many tiles have at most this many times the records.
constexpr std::size_t kFinerGrowth = 5;

/// Direction of a pixel's ray, in homogeneous (t, i), as x · columns[0] + y · columns[1] + columns[2] with x
/// and y in [0, 1] over the view.
std::array<glm::vec4, 3> pixelRays(const View& view, const glm::dmat4& homogeneousFromWorld) {
  const glm::dmat4 worldFromClip = glm::inverse(view.clipFromWorld);
  const auto direction = [&](double x, double y) {
    const glm::dvec4 p = worldFromClip * glm::dvec4(x, y, 0.0, 1.0);
    return homogeneousFromWorld * glm::dvec4(glm::dvec3(p) / p.w - view.eyeWorld, 0.0);
  };
  const glm::dvec4 corner = direction(-1, -1);
  // Only directions matter: at unit scale single precision has them all.
  const double unit = 1.0 / std::max(glm::length(corner), 1e-300);
  return {glm::vec4(unit * (direction(1, -1) - corner)), glm::vec4(unit * (direction(-1, 1) - corner)),
          glm::vec4(unit * corner)};
}

/// What makes the plane of a facet, in homogeneous (t, i), from a vertex of it and its normal, both in object
/// space: there a wide ground's plane is as exact as its corners are.
struct FacetPlanes {
  glm::vec3 t[2];
  glm::vec4 i, one;  ///< xyz + w · vertex, times the normal
};
FacetPlanes facetPlanes(const outlines::ListSpace& space, const glm::dmat4& worldFromObject) {
  const glm::dmat4 rows = space.homogeneousFromWorld() * worldFromObject;
  glm::dmat3 linear;
  for (int column = 0; column < 3; ++column)
    linear[column] = {rows[column].x, rows[column].y, rows[column].w};
  const glm::dvec3 offset(rows[3].x, rows[3].y, rows[3].w);
  const glm::dmat3 inverse = glm::inverse(linear);
  const glm::dvec3 lightObject = -(inverse * offset);
  const bool centred = space.originI > 0.0;
  const glm::dvec3 originObject =
      centred ? inverse * (glm::dvec3(0.0, 0.0, 1.0 / space.originI) - offset) : glm::dvec3(0.0);
  const glm::dvec4 one =
      centred ? space.originI * glm::dvec4(originObject, -1.0) : glm::dvec4(inverse[2], 0.0);
  double largest = std::max(glm::length(inverse[0]), glm::length(inverse[1]));
  largest = std::max({largest, glm::length(glm::dvec3(one)), glm::length(lightObject)});
  const double scale = 1.0 / std::max(largest, 1e-300);
  return {{glm::vec3(scale * inverse[0]), glm::vec3(scale * inverse[1])},
          glm::vec4(scale * glm::dvec4(lightObject, -1.0)),
          glm::vec4(scale * one)};
}

bool isListed(const DrawItem& item, const ListRequest& request) {
  return request.receivers == ListedReceivers::all || item.casts;
}
std::size_t countListed(const LightFrame& frame, const ListRequest& request) {
  return static_cast<std::size_t>(
      std::ranges::count_if(frame.receivers, [&](const DrawItem& item) { return isListed(item, request); }));
}

/// Whether faces of the receiver may be seen from behind: it has openings, or the near plane opens it.
bool maySeeBehind(const View& view, const DrawItem& item) {
  if (!item.closed) return true;
  return hiddenFaces(item, view.eyeWorld, view.nearReach) == gl::Cull::none &&
         std::ranges::any_of(item.boundsWorld.corners(), [&](const glm::dvec3& corner) {
           const glm::dvec4 clip = view.clipFromWorld * glm::dvec4(corner, 1.0);
           return clip.z < -clip.w;
         });
}

/// Where a box lies in (t, i), and its least i.
struct Reach {
  outlines::TangentRect rect;
  double farthest = 1e300;
  void include(const scene::Bounds& boundsWorld, const outlines::ListSpace& space, double minHeight) {
    for (const glm::dvec3& corner : boundsWorld.corners()) {
      glm::dvec3 abh = space.plane.fromWorld(corner);
      if (abh.z < minHeight) {
        rect = {.low = glm::dvec2(-1e30), .high = glm::dvec2(1e30)};
        continue;
      }
      const glm::dvec3 ti = space.tangentPoint(abh);
      rect.low = glm::min(rect.low, glm::dvec2(ti));
      rect.high = glm::max(rect.high, glm::dvec2(ti));
      farthest = std::min(farthest, ti.z);
    }
  }
};

}  // namespace

glm::vec4 listPlace(const LightFrame& frame, double minHeight) {
  // Half precision has 11 bits.
  const double rounding = frame.capabilities.has(device::Capability::highp) ? outlines::kPlaceRounding : 1e-3;
  const auto bias = static_cast<float>(frame.settings.real("bias"));
  return {static_cast<float>(minHeight), 2.0f * bias, bias, bias * static_cast<float>(rounding)};
}

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

bool LightLists::boundShadows(const LightFrame& frame) {
  if (sceneKey_ == frame.sceneKey) return true;
  sceneKey_ = frame.sceneKey;
  // Of all objects, not of those in view, or tiles would follow the camera.
  Reach reach;
  for (const auto items : {frame.casters, frame.shadowlessReceivers}) {
    for (const DrawItem& item : items) {
      if (item.receives) reach.include(item.boundsWorld, loops_.space(), loops_.minHeight());
    }
  }
  shadows_ = shadowedTangents(loops_.subLights(), reach.farthest);
  const glm::dvec2 low = glm::max(shadows_.low, reach.rect.low),
                   high = glm::min(shadows_.high, reach.rect.high);
  const scene::LightPlane& plane = loops_.space().plane;
  const glm::dvec2 even =
      kEvenSlope * plane.heightUnit / glm::dvec2(glm::length(plane.halfU), glm::length(plane.halfV));
  outlines::TileScale scale;
  for (int k = 0; k < 2; ++k) {
    if (high[k] - low[k] > kSqueezedFrom * even[k]) scale.squeeze[k] = 1.0 / even[k];
  }
  const glm::dvec2 size = scale.squeezed(high) - scale.squeezed(low);
  const double longer = std::max(size.x, size.y);
  const bool same = longer == shadowSize_ && scale.squeeze == scale_.squeeze;
  scale_ = scale;
  shadowSize_ = longer > 0.0 ? longer : 1.0;
  return same;
}

Status LightLists::update(const LightFrame& frame, const ListRequest& request) {
  const bool loopsChanged = loops_.update(frame, request.subLights);
  if (loopsChanged) sceneKey_ = 0;
  if (!boundShadows(frame)) receivers_.clear();
  if (loopsChanged) {
    surfaces_ = outlines::NearSurfaces(placedCasters(frame), loops_.space(), loops_.minHeight());
    receivers_.clear();
    encoded_.clear();
    std::vector<const void*> geometries;
    for (const DrawItem& caster : frame.casters) geometries.push_back(caster.geometry);
    // Whatever stood here before must not show in the picture.
    if (geometries != casters_) doublings_ = 0;
    casters_ = std::move(geometries);
  }
  const double finest = shadowSize_ / request.tiles;
  const device::Limits& limits = frame.capabilities.limits;
  // The column and row of a list take 24 bits; without highp, coordinates of 1024 rows are exact.
  const int maxRows =
      std::min({limits.textureSize, 65536, frame.capabilities.has(device::Capability::highp) ? 65536 : 1024});
  tileSize_ = finest * std::exp2(doublings_);
  bool changed = !tiles_;
  const std::size_t mostRecords = static_cast<std::size_t>(maxRows) * kRecordsPerRow;
  for (int attempt = 0; attempt < 8; ++attempt) {
    std::vector<const void*> used;
    std::vector<ReceiverLists> receivers;
    std::size_t records = 0;
    for (const DrawItem& item : frame.receivers) {
      if (!isListed(item, request)) continue;
      Receiver& cached = receivers_[item.geometry];
      const bool seenFromBehind = maySeeBehind(frame.screen, item);
      if (cached.revision != item.revision || cached.seenFromBehind != seenFromBehind) {
        cached.revision = item.revision;
        cached.seenFromBehind = seenFromBehind;
        cached.casts = item.casts;
        const outlines::ListedReceiver receiver{.ownObject = placedCasterOf(frame, item)};
        cached.tiles =
            receiverTiles({.mesh = item.sourceMesh,
                           .worldFromObject = item.worldFromObject,
                           .closed = !seenFromBehind,
                           .withPatches = receiver.ownObject != outlines::kNoObject},
                          loops_.space(), shadows_, (item.casts ? kCasterTileShare : 1.0) * tileSize_,
                          kMaxTiles, loops_.minHeight(), scale_);
        cached.lists = tileLists(loops_.subLights(), surfaces_, cached.tiles, receiver, request.edges,
                                 mostRecords - records);
        changed = true;
      }
      // What does not fit is not built to its end.
      records += cached.lists.records.size();
      if (cached.lists.cutShort || records > mostRecords) break;
      used.push_back(item.geometry);
      receivers.push_back({&cached.lists, cached.tiles.columns, cached.tiles.rows});
    }
    // Receivers come in the camera's order; what is encoded does not depend on it.
    std::vector<const void*> inSomeOrder = used;
    std::ranges::sort(inSomeOrder);
    if (!changed && inSomeOrder == encoded_) return {};
    EncodedLists encoded;
    const bool whole = used.size() == countListed(frame, request);
    if (whole && encodeLists(receivers, maxRows, encoded)) {
      if (Status s = uploadList(frame.context, encoded.tiles, tiles_); !s) return s;
      if (Status s = uploadList(frame.context, encoded.records, records_); !s) return s;
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
  const bool among = std::ranges::any_of(receivers_, [](const auto& receiver) {
    return receiver.second.lists.amongReceivers && !receiver.second.casts;
  });
  const bool behind = std::ranges::any_of(
      receivers_, [](const auto& receiver) { return receiver.second.lists.behindFacets; });
  if (behind) shading.defines.push_back("HS_BEHIND_FACETS");
  if (among) shading.defines.push_back("HS_AMONG_RECEIVERS");
  shading.defines.push_back("HS_LISTS");
  shading.mapFromWorld = loops_.space().homogeneousFromWorld();
  const glm::vec2 tileTexel = 1.0f / glm::vec2(tiles_.desc().width, tiles_.desc().height);
  const glm::vec2 recordTexel = 1.0f / glm::vec2(records_.desc().width, records_.desc().height);
  const std::array<glm::vec4, 3> rays = pixelRays(frame.screen, shading.mapFromWorld);
  const glm::vec4 eye(shading.mapFromWorld * glm::dvec4(frame.screen.eyeWorld, 1.0));
  const glm::vec4 place = listPlace(frame, loops_.minHeight());
  shading.setUniforms = [others = std::move(shading.setUniforms), rays, eye, place,
                         texel = glm::vec4(tileTexel, recordTexel)](gl::Program& program,
                                                                    gl::Context& context) {
    if (others) others(program, context);
    program.set(context, "u_cellTexel", texel);
    program.set(context, "u_listPlace", place);
    program.set(context, "u_rayX", rays[0]);
    program.set(context, "u_rayY", rays[1]);
    program.set(context, "u_rayOrigin", rays[2]);
    program.set(context, "u_eyeLight", eye);
  };
  shading.setItemUniforms = [this](gl::Program& program, gl::Context& context, const DrawItem& item) {
    const FacetPlanes planes = facetPlanes(loops_.space(), item.worldFromObject);
    program.set(context, "u_facetT0", planes.t[0]);
    program.set(context, "u_facetT1", planes.t[1]);
    program.set(context, "u_facetI", planes.i);
    program.set(context, "u_facetOne", planes.one);
    const auto found = receivers_.find(item.geometry);
    if (found == receivers_.end() || found->second.tiles.empty()) {
      program.set(context, "u_tileAtlas", glm::vec4(0.0f));
      program.set(context, "u_tileSqueeze", glm::vec2(0.0f));
      return;
    }
    const outlines::ReceiverTiles& tiles = found->second.tiles;
    const glm::dvec2 scale = 1.0 / tiles.tileSize;
    program.set(context, "u_tileSqueeze", glm::vec2(tiles.scale.squeeze));
    program.set(context, "u_tileOfTangent", glm::vec4(glm::dvec4(scale, -tiles.low * scale)));
    program.set(context, "u_tileAtlas",
                glm::vec4(tiles.columns, tiles.rows, found->second.firstTexel.x, found->second.firstTexel.y));
  };
}

}  // namespace halfshadow::techniques
