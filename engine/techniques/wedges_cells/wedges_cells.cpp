// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges_cells/wedges_cells.hpp"

#include <map>

#include "techniques/caster_lists/light_lists.hpp"

namespace halfshadow::techniques {
namespace {
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
            "casters that overlap within one cell count as independent; a hollow of a caster whose own "
            "silhouette passes at its height may be shadowed wholly, since the cut is closed by a "
            "chord; a flat facet whose plane cuts the light loses it by quarters"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    return {{"wedges-cells.bytes",
             SettingType::choice,
             "16",
             0,
             0,
             {"4", "16", "32"},
             "light cells, one byte's worth each: 4 sub-lights of 1, 4 or 8 cells"},
            {"wedges-cells.tiles",
             SettingType::integer,
             "128",
             1,
             kMaxTiles,
             {},
             "tiles of vertex lists along the longer side of what the shadows cover, seen from the light"}};
  }
  Result<ReceiverShading> declare(const LightFrame& frame) override;
  void contextLost() override { lights_.clear(); }

 private:
  std::map<int, LightLists> lights_;
};

Result<ReceiverShading> WedgesCells::declare(const LightFrame& frame) {
  static constexpr auto kQuarters = subLights();
  LightLists& lists = lights_[frame.lightIndex];
  const ListRequest request{.subLights = kQuarters,
                            .edges = ListedEdges::covering,
                            .tiles = frame.settings.integer("wedges-cells.tiles"),
                            .tilesKey = "wedges-cells.tiles"};
  if (Status s = lists.update(frame, request); !s) return s.error();
  ReceiverShading shading;
  shading.fragmentFile = "wedges_cells.frag";
  shading.defines = {"HS_CELLS " + frame.settings.choice("wedges-cells.bytes")};
  lists.provide(frame, shading);
  return shading;
}
}  // namespace

std::unique_ptr<Technique> makeWedgesCells() {
  return std::make_unique<WedgesCells>();
}

}  // namespace halfshadow::techniques
