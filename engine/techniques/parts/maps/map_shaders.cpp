// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/map_shaders.hpp"

#include "planner/sub_lights.hpp"

namespace halfshadow::techniques {

ShaderAxis depthAxis() {
  return {{.needs = {"!HS_NO_HIGHP"}},
          {{"HS_DEPTH_PACKED24"}, {"!HS_NO_HIGHP"}},
          {{"HS_DEPTH_PACKED16"}, {"HS_NO_HIGHP"}}};
}

ShaderAxis subLightAxis() {
  ShaderAxis axis = {{}};
  for (int u = 1; u <= planner::kMostSubLightsPerSide; ++u) {
    for (int v = 1; v <= planner::kMostSubLightsPerSide; ++v) {
      if (u * v == 1) continue;
      axis.push_back(
          {.defines = {"HS_SUB_LIGHTS_U " + std::to_string(u), "HS_SUB_LIGHTS_V " + std::to_string(v)},
           .compiled = u == v && u < planner::kMostSubLightsPerSide});
    }
  }
  return axis;
}

std::vector<ShaderFamily> mapShaders() {
  ShaderAxis tiles = range("HS_TILES", 2, planner::kMostSubLightsPerSide, {2});
  const ShaderAxis several = tiles;
  tiles.emplace_back();
  return {{"map/light_depth.vert", "map/light_depth.frag", {depthAxis()}},
          fullscreen("map/block_bounds.frag",
                     {depthAxis(), values("HS_FACTOR", {2, 4, 8, 16, 32, 64}), flag("HS_FROM_DEPTH")}),
          fullscreen("map/block_dilate.frag",
                     {range("HS_REACH_S", 0, 4, {0, 1, 4}), range("HS_REACH_T", 0, 4, {0, 1, 4}),
                      values("HS_CELL", {1, 2, 4, 8}), tiles}),
          fullscreen("map/block_merge.frag", {several, range("HS_MAPS", 2, 16, {4})}),
          fullscreen("map/occupancy.frag", {depthAxis()}),
          fullscreen("map/occupancy_level.frag", {values("HS_CELL", {1, 2, 4, 8, 16, 32, 64, 128})}),
          fullscreen("map/edge_mask.frag", {depthAxis(), flag("HS_LAPLACIAN9")}),
          fullscreen("map/edge_dilate.frag"),
          fullscreen("map/pyramid_copy.frag")};
}

std::vector<ShaderFamily> mapReceiverFamilies(const std::string& fragmentFile, std::vector<ShaderAxis> axes,
                                              ReceiverTraits traits) {
  traits.usesFacetPlane = true;
  axes.insert(axes.begin(), depthAxis());
  return joined({mapShaders(), receiverFamilies(fragmentFile, traits, std::move(axes))});
}

}  // namespace halfshadow::techniques
