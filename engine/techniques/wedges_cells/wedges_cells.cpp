// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges_cells/wedges_cells.hpp"

#include "techniques/core/light_rooms.hpp"
#include "techniques/parts/lists/dense_casters.hpp"
#include "techniques/parts/lists/own_receivers.hpp"
#include "techniques/wedges_cells/cell_shaders.hpp"
#include "techniques/wedges_cells/cell_targets.hpp"

namespace halfshadow::techniques {
namespace {
constexpr auto kQuarters = outlines::subLights();

enum class Route { gather, scatter, fetch };

/// What this device can do of what is asked for. Errors: none; what is missing is noted.
Route routeOf(const LightScene& scene, PassPlan& plan) {
  std::string asked = scene.settings.choice("wedges-cells.route");
  if (asked == "auto") asked = scene.settings.choice("wedge_route");
  if (asked == "gather") return Route::gather;
  const auto instead = [&](Route route, const std::string& why) {
    plan.note(scene.name + " route " + asked, why);
    return route;
  };
  if (!scene.capabilities.has(device::Capability::highp)) {
    return instead(Route::gather, "a receiver's place needs highp in fragment shaders: cells are gathered");
  }
  if (lightIsInRoom(scene))
    return instead(Route::gather, "the light is inside a closed caster: its faces are gathered");
  if (asked == "fetch" && !scene.capabilities.has(device::Capability::framebufferFetch)) {
    return instead(Route::scatter, "no framebuffer fetch here: cells are multiplied by blending");
  }
  return asked == "fetch" ? Route::fetch : Route::scatter;
}

class WedgesCells final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "wedges-cells",
        .paper = "after Forest, Barthe, Paulin 2006; light cells and gathered lists are this engine's own",
        .summary = "exact coverage of light cells per caster from silhouettes of four sub-lights, multiplied",
        .guarantees =
            "exact up to storage for one convex caster as each sub-light's centre sees it; the order "
            "of casters does not matter",
        .knownFailures =
            "casters that overlap within one cell without touching count as independent; lists of faces grow "
            "with the triangles of casters that are not convex: where they exceed what fragments can walk, "
            "pcss-mip takes the light",
        .takesOutlines = true};
    return info;
  }
  std::optional<StandIn> standIn(const LightScene& scene) const override {
    return standInForDenseCasters(scene);
  }
  std::vector<SettingInfo> settings() const override {
    return {
        {"wedges-cells.bytes",
         SettingType::choice,
         "16",
         0,
         0,
         {"4", "16", "32"},
         "light cells, one byte's worth each: 4 sub-lights of 1, 4 or 8 cells"},
        {"wedges-cells.route",
         SettingType::choice,
         "auto",
         0,
         0,
         {"auto", "gather", "scatter", "fetch"},
         "gather: each receiver fragment walks the casters of its tile; scatter: each caster is drawn over "
         "the receivers, its cells multiplied into targets by blending; fetch: the same by framebuffer "
         "fetch; "
         "auto: wedge_route, the device profile's choice"},
        {"wedges-cells.tiles",
         SettingType::integer,
         "128",
         1,
         kMaxTiles,
         {},
         "most tiles of vertex lists along the longer side of what the shadows cover, seen from the light; "
         "fewer "
         "where they would be narrower than 4 pixels"}};
  }
  std::vector<ShaderFamily> shaderFamilies() const override { return cellShaders(); }
  std::vector<Fallback> fallbacks() const override {
    return {
        shadedApart(),
        shadedApart({{"wedges-cells.bytes", "4"}, {"wedges-cells.route", "gather"}}, "one cell a sub-light"),
        {.text = "distances to silhouettes in maps", .technique = "shadow-width"}};
  }
  std::unique_ptr<LightPlanner> newPlanner() const override;
};

class CellsPlanner final : public LightPlanner {
 public:
  Status plan(const LightScene& scene, PassPlan& plan) override {
    const Route route = routeOf(scene, plan);
    if (route == Route::gather) return gather(scene, plan);
    const int cells = std::stoi(scene.settings.choice("wedges-cells.bytes"));
    const CellProduct product = route == Route::fetch ? CellProduct::fetched : CellProduct::blended;
    if (Status s = planCellTargets(scene, plan, loops_, draws_, cells, product); !s) return s;
    return addOwnReceivers(scene, plan, loops_, lists_, "wedges-cells.tiles", kQuarters, OwnSurfaces::all,
                           screenWalk(scene));
  }

 private:
  static ScreenWalk screenWalk(const LightScene& scene) {
    return {"list/own_cells.frag", {"HS_CELLS " + scene.settings.choice("wedges-cells.bytes")}};
  }

  Status gather(const LightScene& scene, PassPlan& plan) {
    const ListRequest request{.subLights = kQuarters,
                              .edges = outlines::ListedEdges::covering,
                              .tiles = scene.settings.integer("wedges-cells.tiles"),
                              .tilesKey = "wedges-cells.tiles"};
    if (Status s = lists_.update(scene, plan, loops_, request); !s) return s;
    plan.shading.fragmentFile = "list/wedges_cells.frag";
    plan.shading.defines = {"HS_CELLS " + scene.settings.choice("wedges-cells.bytes")};
    lists_.provide(scene, plan, screenWalk(scene));
    // Most fragments have no list; a loop that ends at once still costs a round on some devices.
    if (preferredSkip(scene) == FilterSkip::stencil) plan.shading.skip = FilterSkip::stencil;
    return {};
  }

  LightLoops loops_;
  LightLists lists_;
  CasterDraws draws_;
};

std::unique_ptr<LightPlanner> WedgesCells::newPlanner() const {
  return std::make_unique<CellsPlanner>();
}
}  // namespace

std::unique_ptr<Technique> makeWedgesCells() {
  return std::make_unique<WedgesCells>();
}

}  // namespace halfshadow::techniques
