// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges_blended/wedges_blended.hpp"

#include <algorithm>
#include <optional>

#include "techniques/core/light_rooms.hpp"
#include "techniques/parts/lists/dense_casters.hpp"
#include "techniques/parts/lists/own_receivers.hpp"
#include "techniques/parts/screen/visibility_parts.hpp"
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
std::optional<SideMerge> targetMerge(const LightScene& scene, PassPlan& plan) {
  std::string asked = scene.settings.choice("wedges-blended.merge");
  if (asked == "auto") asked = scene.settings.choice("wedge_merge");
  if (asked == "gather") return std::nullopt;
  const auto note = [&](const char* why) { plan.note(scene.name + " merge " + asked, why); };
  if (!scene.capabilities.has(device::Capability::highp)) {
    note("a receiver's place needs highp in fragment shaders: casters are gathered");
    return std::nullopt;
  }
  if (asked == "fetch" && scene.capabilities.has(device::Capability::framebufferFetch))
    return SideMerge::fetch;
  if (asked == "core") return SideMerge::core;
  const bool minmax = scene.capabilities.has(device::Capability::blendMinmax);
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
            "quadrant add up",
        .takesOutlines = true};
    return info;
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override {
    return standInForDenseCasters(scene);
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
         "most tiles of vertex lists along the longer side of what the shadows cover, seen from the light; "
         "fewer "
         "where they would be narrower than 4 pixels"}};
  }
  std::vector<ShaderFamily> shaderFamilies() const override { return vbufferShaders(); }
  std::vector<Fallback> fallbacks() const override {
    return {shadedApart(),
            shadedApart({{"wedges-blended.cog", "off"}, {"program_size", "short"}},
                        "no centres of gravity, pieces that receivers cut a vertex at a time"),
            shadedApart({{"wedges-blended.cog", "off"}, {"program_size", "parts"}},
                        "no centres of gravity, two quadrants a draw"),
            {.text = "light cells, gathered from lists", .technique = "wedges-cells"}};
  }
  std::unique_ptr<LightPlanner> newPlanner() const override;
};

class BlendedPlanner final : public LightPlanner {
 public:
  Status plan(const LightScene& scene, PassPlan& plan) override {
    if (lightIsInRoom(scene)) {
      plan.note(scene.name + " merge", "the light is inside a closed caster: its faces are gathered");
      return gather(scene, plan);
    }
    const WedgeVolumes& volumes = routes_.volumes(scene);
    if (meetKey_ != volumes.contentKey) {
      meet_ = volumes.takenTogether || castersMeet(volumes);
      meetKey_ = volumes.contentKey;
    }
    // Without highp the lists' fixed-point vertices are the more exact way.
    if (!meet_ && scene.capabilities.has(device::Capability::highp)) return addUp(scene, plan);
    if (const auto merge = targetMerge(scene, plan)) {
      const VbufferRequest request{.merge = *merge, .centres = hasCentres(scene)};
      if (Status s = planVbufferTargets(scene, plan, loops_, draws_, request); !s) return s;
      return addOwn(scene, plan);
    }
    return gather(scene, plan);
  }

 private:
  /// Without overlap there is nothing to blend.
  Status addUp(const LightScene& scene, PassPlan& plan) {
    plan.note("blending", "no two casters shadow the same receiver: their shares are added up");
    // addOwn() gives lists to all that cast.
    routes_.planSums(scene, plan, "auto", CastingReceivers::listed);
    return addOwn(scene, plan);
  }

  static bool hasCentres(const LightScene& scene) {
    return scene.settings.choice("wedges-blended.cog") == "on";
  }
  Status addOwn(const LightScene& scene, PassPlan& plan) {
    return addOwnReceivers(scene, plan, loops_, lists_, "wedges-blended.tiles", {&outlines::kWholeLight, 1},
                           OwnSurfaces::all, ownWalk(plan.shading));
  }

  /// One pass over the receivers; the vBuffers of a fragment are registers.
  Status gather(const LightScene& scene, PassPlan& plan) {
    const ListRequest request{.subLights = {&outlines::kWholeLight, 1},
                              .edges = outlines::ListedEdges::all,
                              .tiles = scene.settings.integer("wedges-blended.tiles"),
                              .tilesKey = "wedges-blended.tiles"};
    if (Status s = lists_.update(scene, plan, loops_, request); !s) return s;
    plan.shading.fragmentFile = "list/wedges_blended.frag";
    if (hasCentres(scene)) plan.shading.defines.push_back("HS_CENTRES");
    lists_.provide(scene, plan, {"list/own_blended.frag", plan.shading.defines});
    // Most fragments have no list; a loop that ends at once still costs a round on some devices.
    if (preferredSkip(scene) == FilterSkip::stencil) plan.shading.skip = FilterSkip::stencil;
    if (hasProgramsInParts(scene)) planVisibilityParts(scene, plan, halvesOf(plan.shading));
    return {};
  }

  static std::vector<ReceiverShading> halvesOf(const ReceiverShading& whole) {
    std::vector<ReceiverShading> halves(2, whole);
    for (std::size_t i = 0; i < halves.size(); ++i)
      halves[i].defines.push_back("HS_HALF " + std::to_string(i));
    return halves;
  }

  WedgeRoutes routes_;
  LightLoops loops_;
  LightLists lists_;
  CasterDraws draws_;
  std::uint64_t meetKey_ = 0;
  bool meet_ = false;
};

std::unique_ptr<LightPlanner> WedgesBlended::newPlanner() const {
  return std::make_unique<BlendedPlanner>();
}
}  // namespace

std::unique_ptr<Technique> makeWedgesBlended() {
  return std::make_unique<WedgesBlended>();
}

}  // namespace halfshadow::techniques
