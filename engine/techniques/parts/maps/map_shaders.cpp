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
      std::vector<std::string> defines = {"HS_SUB_LIGHTS_U " + std::to_string(u),
                                          "HS_SUB_LIGHTS_V " + std::to_string(v)};
      axis.push_back({.defines = defines, .compiled = u == 2 && v == 2});
      if (u * v % 2 == 0) continue;
      defines.emplace_back("HS_ONE_SEARCH");
      axis.push_back({.defines = std::move(defines), .compiled = u == 3 && v == 3});
    }
  }
  return axis;
}

std::vector<ShaderFamily> mapShaders() {
  ShaderAxis tiles = {{}};
  for (int maps = 2; maps <= planner::kMostSubLightsPerSide * planner::kMostSubLightsPerSide; ++maps) {
    const int side = maps <= 4 ? 2 : maps <= 9 ? 3 : 4;
    tiles.push_back({.defines = {"HS_TILES " + std::to_string(side), "HS_MAPS " + std::to_string(maps)},
                     .needs = {"HS_FROM_DEPTH"},
                     .compiled = maps == 9});
  }
  return {{"map/light_depth.vert", "map/light_depth.frag", {depthAxis(), alphaAxis()}},
          fullscreen("map/block_bounds.frag",
                     {depthAxis(), values("HS_FACTOR", {2, 4, 8, 16, 32, 64}), flag("HS_FROM_DEPTH"), tiles}),
          fullscreen("map/block_dilate.frag",
                     {range("HS_REACH_S", 0, 4, {0, 1, 4}), range("HS_REACH_T", 0, 4, {0, 1, 4}),
                      values("HS_CELL", {1, 2, 4, 8})}),
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
