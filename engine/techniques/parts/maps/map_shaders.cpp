// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/maps/map_shaders.hpp"

namespace halfshadow::techniques {

ShaderAxis depthAxis() {
  return {{.needs = {"!HS_NO_HIGHP"}},
          {{"HS_DEPTH_PACKED24"}, {"!HS_NO_HIGHP"}},
          {{"HS_DEPTH_PACKED16"}, {"HS_NO_HIGHP"}}};
}

std::vector<ShaderFamily> mapShaders() {
  return {{"map/light_depth.vert", "map/light_depth.frag", {depthAxis()}},
          fullscreen("map/block_bounds.frag",
                     {depthAxis(), values("HS_FACTOR", {2, 4, 8, 16, 32, 64}), flag("HS_FROM_DEPTH")}),
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
