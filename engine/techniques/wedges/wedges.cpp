// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges/wedges.hpp"

#include "techniques/core/light_rooms.hpp"
#include "techniques/parts/lists/dense_casters.hpp"
#include "techniques/parts/lists/own_receivers.hpp"
#include "techniques/parts/wedges/wedge_route.hpp"
#include "techniques/parts/wedges/wedge_shaders.hpp"

namespace halfshadow::techniques {
namespace {
using framegraph::AttachmentPoint;
using framegraph::InitialContent;
using framegraph::ResourceId;

/// Tiles of the lists for receivers among the surfaces of one caster, which wedges of its silhouette do not
/// shadow.
SettingInfo tilesSetting(const std::string& key) {
  return {
      key,
      SettingType::integer,
      "128",
      1,
      kMaxTiles,
      {},
      "most tiles of vertex lists along the longer side of what the shadows cover, seen from the light, for "
      "the surfaces of casters that are not convex; fewer where they would be narrower than 4 pixels"};
}

WedgeGroup castersWhere(const outlines::WedgePieces& pieces, auto predicate) {
  WedgeGroup group;
  for (std::uint32_t i = 0; i < pieces.casters.size(); ++i) {
    if (!predicate(pieces.casters[i])) continue;
    if (!group.empty() && group.back().first + group.back().count == i) {
      ++group.back().count;
    } else {
      group.push_back({i, 1});
    }
  }
  return group;
}

/// Casters that are one piece, which need no sum, then the batches of the others.
std::vector<WedgeGroup> wholeThenBatches(const outlines::WedgePieces& pieces) {
  std::vector<WedgeGroup> groups;
  groups.push_back(
      castersWhere(pieces, [](const outlines::WedgeCaster& caster) { return caster.pieceCount == 1; }));
  for (std::uint32_t batch = 0; batch < pieces.batchCount; ++batch) {
    groups.push_back(castersWhere(pieces, [batch](const outlines::WedgeCaster& caster) {
      return caster.pieceCount > 1 && caster.batch == batch;
    }));
  }
  return groups;
}

/// Of devices on which receivers' programs have room, if not those of volumes.
std::vector<Fallback> wedgeFallbacks(const std::string& technique) {
  return {shadedApart(),
          shadedApart({{"program_size", "short"}, {technique + ".route", "receivers"}},
                      "pieces that receivers cut a vertex at a time"),
          {.text = "light cells, gathered from lists", .technique = "wedges-cells"}};
}

/// Among casters that were taken together what they cover as one says nothing.
OwnSurfaces listedSurfaces(const WedgeVolumes& volumes) {
  return volumes.takenTogether ? OwnSurfaces::all : OwnSurfaces::hollow;
}

CastingReceivers castingReceivers(const LightScene& scene, OwnSurfaces which) {
  return needsOwnReceivers(scene, which) ? CastingReceivers::listed : CastingReceivers::drawn;
}

class AdditivePlanner final : public LightPlanner {
 public:
  Status plan(const LightScene& scene, PassPlan& plan) override {
    const OwnSurfaces listed = listedSurfaces(routes_.volumes(scene));
    routes_.planSums(scene, plan, scene.settings.choice("wedges.route"), castingReceivers(scene, listed));
    return addOwnReceivers(scene, plan, loops_, lists_, "wedges.tiles", {&outlines::kWholeLight, 1}, listed,
                           ownWalk(plan.shading));
  }

 private:
  WedgeRoutes routes_;
  LightLoops loops_;
  LightLists lists_;
};

class ProbabilisticPlanner final : public LightPlanner {
 public:
  Status plan(const LightScene& scene, PassPlan& plan) override {
    const OwnSurfaces listed = listedSurfaces(routes_.volumes(scene));
    WedgeRoute route = routes_.choose(scene, plan, scene.settings.choice("wedges-probabilistic.route"),
                                      wholeThenBatches, castingReceivers(scene, listed));
    const WedgeVolumes& volumes = route.volumes();
    const ResourceId visibility = screenImage(scene, plan, "wedge visibility");
    const GroupTarget whole{
        .color = visibility, .clear = volumes.lightEnclosed ? 0.0f : 1.0f, .mix = WedgeMix::multiply};
    route.addGroup(scene, plan, 0, "wedges of whole casters", whole, {});
    if (volumes.pieces.batchCount > 0 && !volumes.lightEnclosed) {
      const ResourceId sums = screenImage(scene, plan, "wedge sums");
      for (std::uint32_t batch = 0; batch < volumes.pieces.batchCount; ++batch) {
        const char* again = batch > 0 ? "casters of different batches may shadow the same receiver" : "";
        route.addGroup(scene, plan, batch + 1, "wedges of batch " + std::to_string(batch),
                       {.color = sums, .steps = kStepsOfOne}, again);
        addMerge(scene, plan, volumes, batch, sums, visibility);
      }
    }
    plan.shading = screenShading(scene, visibility, 0.0f);
    return addOwnReceivers(scene, plan, loops_, lists_, "wedges-probabilistic.tiles",
                           {&outlines::kWholeLight, 1}, listed, ownWalk(plan.shading));
  }

 private:
  /// What the batch's casters can shadow on the screen.
  static std::vector<Rect> touched(const LightScene& scene, const WedgeVolumes& volumes,
                                   std::uint32_t batch) {
    const View& view = scene.screen;
    const glm::dmat4 clipFromLight = view.clipFromWorld * outlines::worldFromLight(volumes.plane);
    std::vector<Rect> rects;
    for (const outlines::WedgeCaster& caster : volumes.pieces.casters) {
      if (caster.pieceCount < 2 || caster.batch != batch) continue;
      const auto corners = outlines::volumeHull(caster.extent, caster.extent.nearest, volumes.end());
      if (const auto rect = outlines::screenBounds(corners, clipFromLight, view.width, view.height))
        rects.push_back(*rect);
    }
    return outlines::disjointRects(std::move(rects));
  }

  static void addMerge(const LightScene& scene, PassPlan& plan, const WedgeVolumes& volumes,
                       std::uint32_t batch, ResourceId sums, ResourceId visibility) {
    PlannedPass multiply{
        .name = scene.name + " visibility of batch " + std::to_string(batch),
        .stage = framegraph::PassStage::receiverPrepass,
        .writes = {
            {.resource = visibility, .point = AttachmentPoint::color, .initial = InitialContent::keep}}};
    multiply.rebindReason = "one batch at a time is added up; all of them would not fit in memory";
    for (const Rect& rect : touched(scene, volumes, batch)) {
      PlannedDraw draw{.program = plan.addProgram({"screen/fullscreen.vert", "wedge/wedge_merge.frag", {}}),
                       .textures = {{.sampler = "u_sums", .resource = sums}}};
      draw.uniforms.set("u_wedgeSteps", glm::vec4(kStepsOfOne, 0, 0, 0));
      draw.state.blend = kMultiply;
      draw.state.scissor = rect;
      multiply.draws.push_back(std::move(draw));
    }
    plan.passes.push_back(std::move(multiply));
  }

  WedgeRoutes routes_;
  LightLoops loops_;
  LightLists lists_;
};

class AdditiveWedges final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "wedges",
        .paper = "Akenine-Moller, Assarsson 2002; Lengyel 2005; Forest et al. 2006, section 4.2",
        .summary = "the light's share that each silhouette covers, exactly per caster, summed",
        .guarantees = "exact for one convex caster seen from the light's centre; sums never clamp part-way",
        .knownFailures =
            "too dark where penumbrae of several casters overlap; silhouettes are those of the "
            "light's centre; on a caster that is not convex, layers of it that overlap within a quadrant add "
            "up",
        .takesOutlines = true};
    return info;
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override {
    auto dense = standInForDenseCasters(scene);
    return dense ? dense : standInForRooms(scene);
  }
  std::vector<SettingInfo> settings() const override {
    return {routeSetting("wedges.route"), tilesSetting("wedges.tiles")};
  }
  std::vector<ShaderFamily> shaderFamilies() const override { return wedgeShaders(); }
  std::vector<Fallback> fallbacks() const override { return wedgeFallbacks(info().id); }
  std::unique_ptr<LightPlanner> newPlanner() const override { return std::make_unique<AdditivePlanner>(); }
};

class ProbabilisticWedges final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "wedges-probabilistic",
        .paper = "Assarsson, Dougherty, Mounier, Akenine-Moller 2003",
        .summary = "wedges per caster, multiplied as if casters were independent",
        .guarantees = "exact where one convex caster shadows a receiver; never darker than black",
        .knownFailures =
            "too light where casters side by side cover different parts of the light; silhouettes "
            "are those of the light's centre; on a caster that is not convex, layers of it that overlap "
            "within a quadrant add up",
        .takesOutlines = true};
    return info;
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override {
    auto dense = standInForDenseCasters(scene);
    return dense ? dense : standInForRooms(scene);
  }
  std::vector<SettingInfo> settings() const override {
    return {routeSetting("wedges-probabilistic.route"), tilesSetting("wedges-probabilistic.tiles")};
  }
  std::vector<ShaderFamily> shaderFamilies() const override { return wedgeShaders(); }
  std::vector<Fallback> fallbacks() const override { return wedgeFallbacks(info().id); }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<ProbabilisticPlanner>();
  }
};
}  // namespace

std::unique_ptr<Technique> makeWedges() {
  return std::make_unique<AdditiveWedges>();
}
std::unique_ptr<Technique> makeWedgesProbabilistic() {
  return std::make_unique<ProbabilisticWedges>();
}

}  // namespace halfshadow::techniques
