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

/// Pixels across a tile of a caster, where that is nearest to the eye, up to which tiles are doubled: smaller
/// ones take long to make for little. (On other receivers they tell who stands before all of a tile.)
/// Measured at spheres27, statue and bitmoji of 480x300 pixels, whose tiles were 1 to 3 pixels wide: a moving
/// light costs a tenth to two fifths less, fragments fetch 3 to 16 % more.
constexpr double kWideTilePixels = 4.0;
/// Lists stay while the camera comes nearer, until tiles are so many doublings too wide.
constexpr int kKeptDoublings = 1;

/// Four times as many tiles have at most this many times the records.
constexpr std::size_t kFinerGrowth = 5;

/// Facets of one surface among which receivers of a list may stand: its own, and others'. Where there are
/// more, fragments walk its tree.
constexpr std::size_t kMostOwnFacets = 8, kMostOthersFacets = 4096, kMostOthersRecords = 400;

/// Lists are made so often at most, each time with larger tiles.
constexpr int kMostAttempts = 8;

Error tooManyVertices(const ListRequest& request) {
  return {
      ErrorCode::outOfMemory,
      "the silhouettes' vertex lists exceed what fragments can walk or the largest texture holds; lower " +
          std::string(request.tilesKey) + ", use simpler casters, or a technique of shadow maps"};
}

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
std::size_t countListed(const LightScene& scene, const ListRequest& request) {
  return static_cast<std::size_t>(
      std::ranges::count_if(scene.receivers, [&](const DrawItem& item) { return isListed(item, request); }));
}

/// Whether faces of the receiver may be seen from behind: it has openings, or the near plane opens it.
bool maySeeBehind(const View& view, const DrawItem& item) {
  if (!item.closed) return true;
  return hiddenFaces(item, view.eyeWorld, view.nearReach) == device::Cull::none &&
         std::ranges::any_of(item.boundsWorld.corners(), [&](const glm::dvec3& corner) {
           const glm::dvec4 clip = view.clipFromWorld * glm::dvec4(corner, 1.0);
           return clip.z < -clip.w;
         });
}

/// How often a tile of this side, in tangents, can be doubled and still be no wider than so many pixels where
/// the receiver is nearest to the eye. None where the eye is inside its bounds.
int doublingsToPixels(const View& view, const DrawItem& item, const outlines::ListSpace& space, double side) {
  const scene::Bounds& bounds = item.boundsWorld;
  const glm::dvec3 nearest = glm::clamp(view.eyeWorld, bounds.low, bounds.high);
  const double depth = (view.clipFromWorld * glm::dvec4(nearest, 1.0)).w;
  const double height = space.plane.fromWorld(nearest).z;
  if (!(depth > 0.0) || !(height > 0.0)) return 0;
  const glm::dmat4 rows = glm::transpose(view.clipFromWorld);
  const double pixelsPerUnit = 0.5 * view.height * glm::length(glm::dvec3(rows[1])) / depth;
  const double longer = std::max(glm::length(space.plane.halfU), glm::length(space.plane.halfV));
  const double pixels = side * height * longer * pixelsPerUnit;
  const double times = std::log2(kWideTilePixels / std::max(pixels, 1e-300));
  return static_cast<int>(std::clamp(std::floor(times), 0.0, 16.0));
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

glm::vec4 listPlace(const LightScene& scene, double minHeight) {
  // Half precision has 11 bits.
  const double rounding = scene.capabilities.has(device::Capability::highp) ? outlines::kPlaceRounding : 1e-3;
  const auto bias = static_cast<float>(scene.settings.real("bias"));
  return {static_cast<float>(minHeight), 2.0f * bias, bias, bias * static_cast<float>(rounding)};
}

std::uint32_t addList(PassPlan& plan, std::string name, const ListImage& image, std::uint64_t key) {
  return plan.addTexture({.name = std::move(name),
                          .desc = {.width = image.width, .height = image.height},
                          .key = key,
                          .pixels = [rgba = image.rgba] { return rgba; }});
}

bool LightLists::boundShadows(const LightScene& scene) {
  if (sceneKey_ == scene.sceneKey) return true;
  sceneKey_ = scene.sceneKey;
  // Of all objects, not of those in view, or tiles would follow the camera.
  Reach reach;
  for (const auto items : {scene.casters, scene.shadowlessReceivers}) {
    for (const DrawItem& item : items) {
      if (item.receives) reach.include(item.boundsWorld, loops_->space(), loops_->minHeight());
    }
  }
  shadows_ = shadowedTangents(loops_->subLights(), reach.farthest);
  const glm::dvec2 low = glm::max(shadows_.low, reach.rect.low),
                   high = glm::min(shadows_.high, reach.rect.high);
  const scene::LightPlane& plane = loops_->space().plane;
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

Status LightLists::update(const LightScene& scene, PassPlan& plan, LightLoops& loops,
                          const ListRequest& request) {
  loops.update(scene, plan, request.subLights);
  loops_ = &loops;
  const bool loopsChanged = loopsSeen_ != loops.generation();
  loopsSeen_ = loops.generation();
  if (loopsChanged) sceneKey_ = 0;
  if (!boundShadows(scene)) receivers_.clear();
  if (loopsChanged) {
    surfaces_ = outlines::NearSurfaces(placedCasters(scene), loops_->space(), loops_->minHeight());
    receivers_.clear();
    encoded_.clear();
    std::vector<std::uint64_t> casters;
    for (const DrawItem& caster : scene.casters) casters.push_back(caster.object);
    // Whatever stood here before must not show in the picture.
    if (casters != casters_) doublings_ = casterDoublings_ = 0;
    casters_ = std::move(casters);
  }
  const double finest = shadowSize_ / request.tiles;
  const device::Limits& limits = scene.capabilities.limits;
  bool changed = imageKey_ == 0;
  const bool highp = scene.capabilities.has(device::Capability::highp);
  // The column and row of a list take 24 bits; without highp, coordinates of 1024 rows are exact.
  const int maxRows = std::min({limits.textureSize, 65536, highp ? 65536 : 1024});
  const std::uint32_t longest = highp ? outlines::kLongestList : outlines::kLongestListWithoutHighp;
  const std::size_t mostRecords = static_cast<std::size_t>(maxRows) * kRecordsPerRow;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    std::size_t casterRecords = 0;
    std::vector<std::uint64_t> used;
    std::vector<ReceiverLists> receivers;
    std::size_t records = 0;
    for (const DrawItem& item : scene.receivers) {
      if (!isListed(item, request)) continue;
      Receiver& cached = receivers_[item.object];
      const bool seenFromBehind = maySeeBehind(scene.screen, item);
      const double side = item.casts ? kCasterTileShare * finest * std::exp2(casterDoublings_)
                                     : finest * std::exp2(doublings_);
      const int doublings = item.casts ? doublingsToPixels(scene.screen, item, loops_->space(), side) : 0;
      if (cached.revision != item.revision || cached.seenFromBehind != seenFromBehind ||
          doublings + kKeptDoublings < cached.doublings) {
        cached.revision = item.revision;
        cached.seenFromBehind = seenFromBehind;
        cached.doublings = doublings;
        cached.casts = item.casts;
        outlines::ListedReceiver receiver{.ownObject = placedCasterOf(scene, item),
                                          .detail = scene.settings.real("outline_detail")};
        if (highp) {
          receiver.mostOwnFacets = kMostOwnFacets;
          receiver.mostOthersFacets = kMostOthersFacets;
          receiver.mostOthersRecords = kMostOthersRecords;
        }
        cached.tiles = receiverTiles({.mesh = item.sourceMesh,
                                      .worldFromObject = item.worldFromObject,
                                      .closed = !seenFromBehind,
                                      .withPatches = receiver.ownObject != outlines::kNoObject},
                                     loops_->space(), shadows_, side * std::exp2(doublings), kMaxTiles,
                                     loops_->minHeight(), scale_);
        cached.lists = tileLists(loops_->subLights(), surfaces_, cached.tiles, receiver, request.edges,
                                 mostRecords - records, scene.workers);
        changed = true;
      }
      // What does not fit is not built to its end.
      records += cached.lists.records.size();
      if (item.casts) casterRecords += cached.lists.records.size();
      if (cached.lists.cutShort || records > mostRecords) break;
      if (cached.lists.longestList > longest) return tooManyVertices(request);
      used.push_back(item.object);
      receivers.push_back({&cached.lists, cached.tiles.columns, cached.tiles.rows});
    }
    // Receivers come in the camera's order; what is encoded does not depend on it.
    std::vector<std::uint64_t> inSomeOrder = used;
    std::ranges::sort(inSomeOrder);
    if (!changed && inSomeOrder == encoded_) return {};
    EncodedLists encoded;
    const bool whole = used.size() == countListed(scene, request);
    if (whole && encodeLists(receivers, maxRows, encoded)) {
      tiles_ = std::move(encoded.tiles);
      records_ = std::move(encoded.records);
      ++imageKey_;
      for (std::size_t i = 0; i < used.size(); ++i) receivers_[used[i]].firstTexel = encoded.firstTexel[i];
      encoded_ = std::move(inSomeOrder);
      // The next lists are tried finer where these would have fitted.
      int& doublings = casterDoublings_ > 0 ? casterDoublings_ : doublings_;
      if (doublings > 0 && encoded.rows * kFinerGrowth < static_cast<std::size_t>(maxRows)) --doublings;
      return {};
    }
    // Half as many tiles a side: lists grow by less than their number shrinks. Those of casters' own surfaces
    // hold faces, and what lies on the ground must not pay for them.
    const bool ofCasters = 2 * casterRecords > records;
    ++(ofCasters ? casterDoublings_ : doublings_);
    std::erase_if(receivers_, [&](const auto& kept) { return kept.second.casts == ofCasters; });
    plan.note(std::string(request.tilesKey),
              std::string("the lists exceed the largest texture; tiles are twice as large") +
                  (ofCasters ? " on casters" : ""));
  }
  return tooManyVertices(request);
}

bool LightLists::haveTrees() const {
  return std::ranges::any_of(receivers_,
                             [](const auto& receiver) { return !receiver.second.lists.trees.empty(); });
}

ListReads LightLists::reads(const LightScene& scene, PassPlan& plan) const {
  ListReads reads;
  const auto any = [this](auto holds) {
    return std::ranges::any_of(receivers_, [&](const auto& receiver) { return holds(receiver.second); });
  };
  const bool trees = haveTrees();
  if (trees || any([](const Receiver& receiver) { return receiver.lists.oneSided; }))
    reads.defines.push_back("HS_ONE_SIDED");
  if (any([](const Receiver& receiver) { return receiver.lists.behindFacets; }))
    reads.defines.push_back("HS_BEHIND_FACETS");
  if (trees) reads.defines.push_back("HS_TREES");
  if (any([](const Receiver& receiver) { return receiver.lists.sides; })) reads.defines.push_back("HS_SIDES");
  reads.textures = {{.sampler = "u_cellTiles", .own = addList(plan, "list tiles", tiles_, imageKey_)},
                    {.sampler = "u_cellLists", .own = addList(plan, "list records", records_, imageKey_)}};
  const glm::vec2 tileTexel = 1.0f / glm::vec2(tiles_.width, tiles_.height);
  const glm::vec2 recordTexel = 1.0f / glm::vec2(records_.width, records_.height);
  reads.mapFromWorld = loops_->space().homogeneousFromWorld();
  reads.uniforms.set("u_cellTexel", glm::vec4(tileTexel, recordTexel));
  reads.uniforms.set("u_listPlace", listPlace(scene, loops_->minHeight()));
  reads.uniforms.set("u_eyeLight", glm::vec4(reads.mapFromWorld * glm::dvec4(scene.screen.eyeWorld, 1.0)));
  reads.tilesOf = [this](const DrawItem& item, device::UniformList& uniforms) {
    const auto found = receivers_.find(item.object);
    if (found == receivers_.end() || found->second.tiles.empty()) {
      uniforms.set("u_tileAtlas", glm::vec4(0.0f));
      uniforms.set("u_tileSqueeze", glm::vec2(0.0f));
      return;
    }
    const outlines::ReceiverTiles& tiles = found->second.tiles;
    const glm::dvec2 scale = 1.0 / tiles.tileSize;
    uniforms.set("u_tileSqueeze", glm::vec2(tiles.scale.squeeze));
    uniforms.set("u_tileOfTangent", glm::vec4(glm::dvec4(scale, -tiles.low * scale)));
    uniforms.set("u_tileAtlas", glm::vec4(tiles.columns, tiles.rows, found->second.firstTexel.x,
                                          found->second.firstTexel.y));
  };
  return reads;
}

void LightLists::provide(const LightScene& scene, PassPlan& plan, const ScreenWalk& own) const {
  const ListReads reads = this->reads(scene, plan);
  ReceiverShading& shading = plan.shading;
  shading.forward = false;
  shading.usesFacetPlane = true;
  shading.selfReceivers = ReceiverShading::SelfReceivers::casting;
  shading.defines.insert(shading.defines.end(), reads.defines.begin(), reads.defines.end());
  const bool among = std::ranges::any_of(receivers_, [](const auto& receiver) {
    return receiver.second.lists.amongReceivers && !receiver.second.casts;
  });
  if (among) shading.defines.push_back("HS_AMONG_RECEIVERS");
  shading.defines.push_back("HS_LISTS");
  shading.textures.insert(shading.textures.end(), reads.textures.begin(), reads.textures.end());
  shading.mapFromWorld = reads.mapFromWorld;
  for (const device::UniformList::Entry& entry : reads.uniforms.entries())
    shading.uniforms.set(entry.key, entry.value);
  const std::array<glm::vec4, 3> rays = pixelRays(scene.screen, shading.mapFromWorld);
  shading.uniforms.set("u_rayX", rays[0]);
  shading.uniforms.set("u_rayY", rays[1]);
  shading.uniforms.set("u_rayOrigin", rays[2]);
  shading.itemUniforms = [this, tilesOf = reads.tilesOf](const DrawItem& item,
                                                         device::UniformList& uniforms) {
    const FacetPlanes planes = facetPlanes(loops_->space(), item.worldFromObject);
    uniforms.set("u_facetT0", planes.t[0]);
    uniforms.set("u_facetT1", planes.t[1]);
    uniforms.set("u_facetI", planes.i);
    uniforms.set("u_facetOne", planes.one);
    tilesOf(item, uniforms);
  };
  if (const auto walkers = screenWalkers(scene, haveTrees()))
    planScreenWalk(scene, plan, *walkers, reads, own);
}

}  // namespace halfshadow::techniques
