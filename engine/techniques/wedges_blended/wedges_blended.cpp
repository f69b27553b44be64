// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges_blended/wedges_blended.hpp"

#include <algorithm>
#include <optional>

#include "techniques/core/light_rooms.hpp"
#include "techniques/parts/lists/own_receivers.hpp"
#include "techniques/parts/wedges/wedge_route.hpp"
#include "techniques/wedges_blended/vbuffer_shaders.hpp"
#include "techniques/wedges_blended/vbuffer_targets.hpp"

namespace halfshadow::techniques {
namespace {
/// Whether some receiver can lie in the penumbrae of two casters.
bool castersMeet(const WedgeVolumes& volumes) {
  std::vector<const outlines::WedgeCaster*> byA;
  for (const outlines::WedgeCaster& caster : volumes.pieces.casters) byA.push_back(&caster);
  for (std::size_t i = 0; i < byA.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (byA[i]->extent.meets(byA[k]->extent, volumes.farthest)) return true;
    }
  }
  return false;
}

/// How targets are to be merged here; nothing when vBuffers stay in registers. What is missing is noted.
std::optional<SideMerge> targetMerge(const LightFrame& frame) {
  std::string asked = frame.settings.choice("wedges-blended.merge");
  if (asked == "auto") asked = frame.settings.choice("wedge_merge");
  if (asked == "gather") return std::nullopt;
  const auto note = [&](const char* why) {
    frame.graph.noteSkipped("light " + std::to_string(frame.lightIndex) + " merge " + asked, why);
  };
  if (!frame.capabilities.has(device::Capability::highp)) {
    note("a receiver's place needs highp in fragment shaders: casters are gathered");
    return std::nullopt;
  }
  if (asked == "fetch" && frame.capabilities.has(device::Capability::framebufferFetch))
    return SideMerge::fetch;
  if (asked == "core") return SideMerge::core;
  const bool minmax = frame.capabilities.has(device::Capability::blendMinmax);
  if (asked == "fetch") note("no framebuffer fetch here: rectangles are united by blending");
  if (!minmax) note("no EXT_blend_minmax here: rectangles are united by fixed functions of the core");
  return minmax ? SideMerge::minmax : SideMerge::core;
}

class WedgesBlended final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "wedges-blended",
        .paper = "Forest, Barthe, Paulin 2006; centres of gravity are its future work",
        .summary =
            "coverage per caster and quadrant of the light, less the overlap that rectangles and "
            "centres of gravity tell",
        .guarantees =
            "exact where one convex caster shadows a receiver, seen from the light's centre; never "
            "darker than without overlap, never lighter than the darkest caster",
        .knownFailures =
            "what both of two casters occlude within a quadrant is estimated; silhouettes are "
            "those of the light's centre; on a caster that is not convex, layers of it that overlap within a "
            "quadrant add up"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    return {
        {"wedges-blended.cog",
         SettingType::choice,
         "off",
         0,
         0,
         {"on", "off"},
         "whether centres of gravity tell where in its rectangle a caster occludes: a third less error for "
         "a third more time"},
        {"wedges-blended.merge",
         SettingType::choice,
         "auto",
         0,
         0,
         {"auto", "gather", "core", "minmax", "fetch"},
         "how casters are merged: gather keeps vBuffers in registers, a receiver fragment walks the casters "
         "of "
         "its tile; the others keep them in targets and draw caster by caster: rectangles united by fixed "
         "functions of the core, by the larger of two (EXT_blend_minmax), or by framebuffer fetch; auto: "
         "wedge_merge, the device profile's choice"},
        {"wedges-blended.tiles",
         SettingType::integer,
         "128",
         1,
         kMaxTiles,
         {},
         "tiles of vertex lists along the longer side of what the shadows cover, seen from the light"}};
  }
  std::vector<ShaderFamily> shaderFamilies() const override { return vbufferShaders(); }
  Result<ReceiverShading> declare(const LightFrame& frame) override {
    if (lightIsInRoom(frame)) {
      frame.graph.noteSkipped("light " + std::to_string(frame.lightIndex) + " merge",
                              "the light is inside a closed caster: its faces are gathered");
      return gather(frame, lights_[frame.lightIndex].lists);
    }
    const WedgeVolumes& volumes = routes_.volumes(frame);
    Light& light = lights_[frame.lightIndex];
    if (light.meetKey != volumes.contentKey) {
      light.meet = castersMeet(volumes);
      light.meetKey = volumes.contentKey;
    }
    // Without highp the lists' fixed-point vertices are the more exact way.
    if (!light.meet && frame.capabilities.has(device::Capability::highp)) return addUp(frame, light.lists);
    if (const auto merge = targetMerge(frame)) {
      const bool centres = frame.settings.choice("wedges-blended.cog") == "on";
      return withOwn(declareVbufferTargets(frame, light.draws, {.merge = *merge, .centres = centres}), frame,
                     light.lists);
    }
    return gather(frame, light.lists);
  }
  void contextLost() override {
    lights_.clear();
    routes_.contextLost();
  }

 private:
  struct Light {
    LightLists lists;
    CasterDraws draws;
    std::uint64_t meetKey = 0;
    bool meet = false;
  };

  /// Without overlap there is nothing to blend.
  Result<ReceiverShading> addUp(const LightFrame& frame, LightLists& lists) {
    frame.graph.noteSkipped("blending", "no two casters shadow the same receiver: their shares are added up");
    return withOwn(routes_.declareSums(frame, "auto"), frame, lists);
  }

  static Result<ReceiverShading> withOwn(Result<ReceiverShading> shading, const LightFrame& frame,
                                         LightLists& lists) {
    return techniques::withOwnReceivers(std::move(shading), frame, lists, "wedges-blended.tiles",
                                        {&outlines::kWholeLight, 1}, OwnSurfaces::all);
  }

  /// One pass over the receivers; the vBuffers of a fragment are registers.
  static Result<ReceiverShading> gather(const LightFrame& frame, LightLists& lists) {
    const ListRequest request{.subLights = {&outlines::kWholeLight, 1},
                              .edges = outlines::ListedEdges::all,
                              .tiles = frame.settings.integer("wedges-blended.tiles"),
                              .tilesKey = "wedges-blended.tiles"};
    if (Status s = lists.update(frame, request); !s) return s.error();
    ReceiverShading shading;
    shading.fragmentFile = "list/wedges_blended.frag";
    if (frame.settings.choice("wedges-blended.cog") == "on") shading.defines.push_back("HS_CENTRES");
    lists.provide(frame, shading);
    // Most fragments have no list; a loop that ends at once still costs a round on some devices.
    if (preferredSkip(frame) == FilterSkip::stencil) shading.skip = FilterSkip::stencil;
    return shading;
  }

  WedgeRoutes routes_;
  std::map<int, Light> lights_;
};
}  // namespace

std::unique_ptr<Technique> makeWedgesBlended() {
  return std::make_unique<WedgesBlended>();
}

}  // namespace halfshadow::techniques
