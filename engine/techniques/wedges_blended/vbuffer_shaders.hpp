// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variants of the shaders of vBuffers.
#pragma once

#include "techniques/parts/wedges/wedge_shaders.hpp"

namespace halfshadow::techniques {

/// By target, casters before and way of merging; see caster_blend.frag.
inline ShaderAxis blendAxis() {
  ShaderAxis axis = {{{"HS_BLEND 0"}},
                     {{"HS_BLEND 0", "HS_CENTRES", "HS_HALVES"}},
                     {{"HS_BLEND 1"}},
                     {{"HS_BLEND 1", "HS_MERGED"}}};
  for (const char* quadrant : {"HS_QUADRANT 0", "HS_QUADRANT 1", "HS_QUADRANT 2", "HS_QUADRANT 3"}) {
    axis.push_back({{"HS_BLEND 2", quadrant}});
    axis.push_back({{"HS_BLEND 2", quadrant, "HS_MERGED"}});
    axis.push_back({{"HS_BLEND 2", quadrant, "HS_USE_FETCH"}});
  }
  for (const char* centre : {"HS_BLEND 3", "HS_BLEND 4"}) {
    axis.push_back({{centre, "HS_CENTRES"}});
    axis.push_back({{centre, "HS_CENTRES", "HS_MERGED", "HS_USE_FETCH"}});
    axis.push_back({{centre, "HS_CENTRES", "HS_MERGED", "HS_HALVES"}});
  }
  return axis;
}

inline std::vector<ShaderFamily> vbufferShaders() {
  return joined({wedgeShaders(),
                 {{"list/caster_volume.vert",
                   "list/caster_blend.frag",
                   {blendAxis(), castingAxis(), flag("HS_SIDES", {"HS_CASTING_RECEIVER"})}},
                  fullscreen("list/vbuffer_add.frag")},
                 listReceiverFamilies("list/wedges_blended.frag", ListedIn::always,
                                      {flag("HS_CENTRES"), {{}, {{"HS_HALF 0"}}, {{"HS_HALF 1"}}}}),
                 screenWalkFamilies("list/own_blended.frag", {flag("HS_CENTRES")})});
}

}  // namespace halfshadow::techniques
