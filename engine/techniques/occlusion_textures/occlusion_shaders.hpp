// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variants of the shaders of occlusion textures.
#pragma once

#include "planner/sub_lights.hpp"
#include "techniques/core/shader_families.hpp"

namespace halfshadow::techniques {

/// At most 16 slices: two a texture where they have depths, else four.
inline ShaderAxis slotsAxis() {
  ShaderAxis axis;
  for (const int each : {2, 4}) {
    for (int textures = 1; textures * each <= 16; ++textures) {
      axis.push_back(
          {{"HS_TEXTURES " + std::to_string(textures), "HS_SLOTS " + std::to_string(textures * each)},
           {each == 2 ? "HS_SLICE_DEPTH" : "!HS_SLICE_DEPTH"},
           textures == 1 || textures == 2 || textures * each == 16});
    }
  }
  return axis;
}

/// Any grid, with a search for each sub-light or one for all.
inline ShaderAxis gridAxis(const std::vector<std::string>& needs) {
  ShaderAxis axis = {{}};
  for (int u = 1; u <= planner::kMostSubLightsPerSide; ++u) {
    for (int v = 1; v <= planner::kMostSubLightsPerSide; ++v) {
      if (u * v == 1) continue;
      std::vector<std::string> defines = {"HS_SUB_LIGHTS_U " + std::to_string(u),
                                          "HS_SUB_LIGHTS_V " + std::to_string(v)};
      axis.push_back({defines, needs, u == 3 && v == 3});
      defines.emplace_back("HS_ONE_SEARCH");
      axis.push_back({std::move(defines), needs, u == 2 && v == 2});
    }
  }
  return axis;
}

inline std::vector<ShaderFamily> occlusionShaders(int mostBoxes) {
  const std::vector<std::string> nearest = {"HS_SLICE_DEPTH"};
  const std::vector<std::string> split = {"HS_SLICE_DEPTH", "HS_CONCENTRIC"};
  return joined(
      {{{"occlusion/occlusion_slices.vert",
         "occlusion/occlusion_slices.frag",
         {{{}, {{"HS_PACK_DEPTH"}}, {{"HS_SLICE_DEPTH"}}, {{"HS_SLICE_DEPTH", "HS_LAST_RECEIVERS"}}},
          alphaAxis()}},
        fullscreen("occlusion/occlusion_level.frag", {flag("HS_FIRST_LEVEL"), flag("HS_TILED")}),
        fullscreen("occlusion/occlusion_sum.frag", {flag("HS_FIRST_STEP"), flag("HS_TILED")}),
        fullscreen("occlusion/occlusion_mip.frag"),
        fullscreen("occlusion/occlusion_sort.frag", {flag("HS_LAST_RECEIVERS")}),
        fullscreen("map/pyramid_copy.frag")},
       receiverFamilies("occlusion/occlusion_textures.frag", {},
                        {slotsAxis(),
                         range("HS_BOXES", 1, mostBoxes, {1, mostBoxes}),
                         {{{"HS_FILTER_NBUFFER"}},
                          {{"HS_FILTER_MIPMAP"}},
                          {{"HS_FILTER_SAT"}, {"!HS_SLICE_DEPTH"}},
                          {{"HS_FILTER_SAT", "HS_SAT_SMOOTH"}, nearest}},
                         {{{"HS_COMBINE_SUM"}}, {{"HS_COMBINE_PRODUCT"}}, {{"HS_COMBINE_MAX"}}},
                         flag("HS_SLICE_DEPTH"),
                         flag("HS_CONCENTRIC"),
                         castingAxis(nearest),
                         gridAxis(split),
                         flag("HS_LAST_RECEIVERS", nearest)}),
       receiverFamilies("screen/screen_visibility.frag", {.forward = false})});
}

}  // namespace halfshadow::techniques
