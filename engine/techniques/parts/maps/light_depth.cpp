// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/light_depth.hpp"

#include <algorithm>

#include "base/keys.hpp"
#include "techniques/parts/maps/byte_ramp.hpp"
#include "techniques/parts/maps/last_receivers.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::Attachment;
using framegraph::AttachmentPoint;
using framegraph::Format;
using framegraph::ResourceDesc;

/// Writes of the depth pass; the last sampled one is the map.
std::vector<Attachment> depthTargets(PassPlan& plan, const ResourceDesc& map, DepthStorage storage,
                                     float emptyDepth, framegraph::ResourceId& mapImage) {
  const bool isTexture = storage == DepthStorage::texture24 || storage == DepthStorage::texture16;
  ResourceDesc desc = map;
  if (isTexture) {
    desc.format = storage == DepthStorage::texture24 ? Format::depth24 : Format::depth16;
    mapImage = plan.addImage(desc);
    return {{.resource = mapImage, .point = AttachmentPoint::depth, .clear = {.depth = emptyDepth}}};
  }
  mapImage = plan.addImage(desc);
  const auto depth = plan.addImage({.name = map.name + " depth test",
                                    .width = map.width,
                                    .height = map.height,
                                    .format = Format::depth24,
                                    .storage = framegraph::Storage::renderbuffer});
  return {{.resource = mapImage,
           .point = AttachmentPoint::color,
           .clear = {.color = {emptyDepth, emptyDepth, emptyDepth, 1}}},
          {.resource = depth, .point = AttachmentPoint::depth, .clear = {.depth = emptyDepth}}};
}

bool keepsFarthest(MapContent content) {
  return content == MapContent::castersFarthest || content == MapContent::lastReceivers;
}

const char* contentName(MapContent content) {
  switch (content) {
    case MapContent::casters:
      return " depth";
    case MapContent::castersFarthest:
      return " farthest depth";
    case MapContent::castersAndReceivers:
      return " depth with receivers";
    case MapContent::lastReceivers:
      return " last receivers' depth";
  }
  return "";
}

/// The part of space before the near distance instead, all of it at depth 0.
MapSpace beforeNear(const MapSpace& space) {
  // A millionth of the near distance is nearer than a fit's own units tell apart; the seam overlaps by a
  // hundredth of the least depth that is kept free of casters.
  constexpr double kFrom = 1e-6, kTo = 1.0 + 1e-5;
  // Clip depth over w is a + b / w: -1 at kFrom, 1 at kTo.
  const double b = -2.0 / (1.0 / kFrom - 1.0 / kTo), a = 1.0 - b / kTo;
  MapSpace before = space;
  for (int column = 0; column < 4; ++column)
    before.mapClipFromWorld[column][2] = a * before.mapClipFromWorld[column][3];
  before.mapClipFromWorld[3][2] += b;
  return before;
}

PlannedDraw depthDraw(PassPlan& plan, const MapSpace& space, DepthStorage storage, MapContent content,
                      std::span<const DrawItem> items) {
  PlannedDraw draw{
      .program = plan.addProgram({"map/light_depth.vert", "map/light_depth.frag", depthDefines(storage)})};
  draw.state.depth = {.test = keepsFarthest(content) ? device::Compare::greater : device::Compare::less,
                      .write = true};
  draw.uniforms.set("u_depthOfDistance", glm::vec2(1.0f, 1.0f));
  draw.what = MeshDraw{
      .items = items,
      .clipFromWorld = space.mapClipFromWorld,
      .clipFromObject = "u_mapClipFromObject",
      .faces = content == MapContent::castersFarthest ? MeshDraw::Faces::averted : MeshDraw::Faces::turned,
      .eyeWorld = space.originWorld};
  return draw;
}
}  // namespace

namespace {
/// Casters as one view sees them, into its part of the atlas.
struct DepthDraws {
  std::span<const DrawItem> items, others, infinite;
  DepthStorage storage = DepthStorage::texture24;
  MapContent content = MapContent::casters;

  void add(PassPlan& plan, PlannedPass& pass, const LightView& view) const {
    const std::size_t first = pass.draws.size();
    const MapSpace space = makeMapSpace(view.fit, storage);
    for (const std::span<const DrawItem> drawn : {items, others}) {
      if (!drawn.empty()) pass.draws.push_back(depthDraw(plan, space, storage, content, drawn));
    }
    // What is farthest is never before the near distance.
    if (view.fit.castersBeforeNear && !keepsFarthest(content)) {
      for (const std::span<const DrawItem> drawn : {items, others}) {
        if (drawn.empty()) continue;
        PlannedDraw& draw =
            pass.draws.emplace_back(depthDraw(plan, beforeNear(space), storage, content, drawn));
        draw.uniforms.set("u_depthOfDistance", glm::vec2(0.0f));
        draw.state.depthRange = glm::vec2(0.0f);
      }
    }
    if (!infinite.empty()) {
      MapSpace flat = space;
      flat.mapClipFromWorld = almostInfinitelyFar(flat.mapClipFromWorld);
      pass.draws.push_back(depthDraw(plan, flat, storage, content, infinite));
      // The ramp repeats at depth 1.
      pass.draws.back().uniforms.set("u_depthOfDistance", glm::vec2(1.0f, 1e-3f));
    }
    for (std::size_t i = first; i < pass.draws.size(); ++i) pass.draws[i].viewport = view.rect;
  }
};

/// All of one content key but for what the content adds.
LightDepth planDepth(const LightScene& scene, const AtlasViews& atlas, PassPlan& plan, MapContent content) {
  const LightView& view = atlas.views.front();
  LightDepth depth{
      .storage = depthStorageFor(scene.capabilities), .content = content, .atlasSize = atlas.atlasSize};
  const bool all = content == MapContent::castersAndReceivers;
  const bool kept = view.contentKey != 0;
  depth.contentKey =
      !kept
          ? 0
          : combineKeys(all ? view.sceneKey : view.contentKey,
                        static_cast<std::uint64_t>(depth.storage) * 4 + static_cast<std::uint64_t>(content));
  DepthDraws draws{.items = view.casters, .storage = depth.storage, .content = content};
  if (content == MapContent::lastReceivers) {
    LastReceivers receivers = lastReceivers(scene);
    depth.contentKey = combineKeys(depth.contentKey, receivers.contentKey);
    draws.items = plan.keep(std::move(receivers.drawn));
    draws.infinite = plan.keep(std::move(receivers.infinite));
  }
  if (all) draws.others = scene.shadowlessReceivers;
  PlannedPass pass{.name = scene.name + contentName(content) + view.name,
                   .stage = framegraph::PassStage::light,
                   .contentKey = depth.contentKey};
  pass.writes =
      depthTargets(plan,
                   {.name = pass.name,
                    .width = atlas.atlasSize,
                    .height = atlas.atlasSize,
                    .lifetime = kept ? framegraph::Lifetime::persistent : framegraph::Lifetime::transient},
                   depth.storage, keepsFarthest(content) ? 0.0f : 1.0f, depth.map);
  for (const LightView& each : atlas.views) draws.add(plan, pass, each);
  if (depth.storage == DepthStorage::packed16) {
    const TextureRead ramp{.sampler = "u_byteRamp", .own = addByteRamp(plan)};
    for (PlannedDraw& draw : pass.draws) draw.textures.push_back(ramp);
  }
  plan.passes.push_back(std::move(pass));
  return depth;
}
}  // namespace

LightDepth planLightDepth(const LightScene& scene, const LightView& view, PassPlan& plan,
                          MapContent content) {
  AtlasViews atlas{.views = {view}, .atlasSize = view.fit.mapSize};
  atlas.views.front().rect = {0, 0, view.fit.mapSize, view.fit.mapSize};
  LightDepth depth = planDepth(scene, atlas, plan, content);
  depth.space = makeMapSpace(view.fit, depth.storage);
  return depth;
}

LightDepth planLightDepths(const LightScene& scene, PassPlan& plan, MapContent content) {
  if (scene.subLights == nullptr) return planLightDepth(scene, scene.center, plan, content);
  LightDepth depth = planDepth(scene, atlasViews(scene), plan, content);
  depth.space = makeMapSpace(scene.subLights->shared, depth.storage);
  depth.subLights = scene.subLights;
  return depth;
}

ReceiverShading mapReceiverShading(const LightScene& scene, PassPlan& plan, const LightDepth& depth,
                                   std::string fragmentFile) {
  ReceiverShading shading;
  shading.fragmentFile = std::move(fragmentFile);
  shading.defines = depthDefines(depth.storage);
  // The border of a map of casters is empty, so that clamped taps outside are lit; receivers fill the border.
  if (depth.content == MapContent::castersAndReceivers) shading.defines.push_back("HS_LIT_OUTSIDE");
  shading.mapFromWorld = depth.space.mapFromWorld;
  shading.usesFacetPlane = true;
  shading.textures = {{.sampler = "u_depthMap", .resource = depth.map}};
  if (depth.storage == DepthStorage::packed16)
    shading.textures.push_back({.sampler = "u_byteRamp", .own = addByteRamp(plan)});
  const MapSpace& space = depth.space;
  const double knob = scene.settings.real("bias");
  // Without highp the map position itself is off by up to one texel, so every tap counts as "anywhere".
  const double positionError = depth.storage == DepthStorage::packed16 ? 1.0 : 0.0;
  const double size = space.mapSize;
  // A quarter of the range per texel: the light grazes the facet, whose own shading is then dark anyway.
  const double largestGradient = 0.25 * space.depthUnit;
  const glm::vec4 map(size, 1.0 / size, space.depthUnit, largestGradient);
  const glm::vec4 bias(knob * space.quantum * space.depthUnit, knob * (0.1 + positionError),
                       knob * (0.6 + positionError), 0.0);
  const glm::vec4 plane(space.depthUnit, size, size, largestGradient);
  shading.uniforms.set("u_map", map);
  shading.uniforms.set("u_bias", bias);
  shading.uniforms.set("u_vertexPlane", plane);
  addSubLights(depth, shading);
  return shading;
}

}  // namespace halfshadow::techniques
