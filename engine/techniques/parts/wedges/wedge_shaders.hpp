// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variants of the shaders that draw wedges, by both routes.
#pragma once

#include "techniques/parts/lists/list_shaders.hpp"
#include "techniques/parts/screen/screen_shaders.hpp"

namespace halfshadow::techniques {

inline std::vector<ShaderFamily> wedgeShaders() {
  const std::vector<ShaderAxis> piece = {{{}, {{"HS_WEDGE_CLIP"}}, {{"HS_WEDGE_CLIP", "HS_WEDGE_CHAIN"}}},
                                         flag("HS_WEDGE_MULTIPLY")};
  const ShaderAxis footprint = {
      {}, {{"HS_WEDGE_FOOTPRINT"}}, {{"HS_WEDGE_FOOTPRINT", "HS_WEDGE_EXACT"}, {"!HS_NO_HIGHP"}}};
  return joined({{receiverDepthShader(),
                  {"wedge/wedge_volume.vert", "wedge/wedge_piece.frag", piece},
                  {"wedge/wedge_receiver.vert", "wedge/wedge_receiver.frag", {footprint, piece[0], piece[1]}},
                  fullscreen("wedge/wedge_merge.frag")},
                 listReceiverFamilies("wedge/screen_wedges.frag", ListedIn::castingReceivers,
                                      {{{}, {{"HS_WEDGE_SUMS"}}, {{"HS_WEDGE_SHARES"}}}}),
                 screenWalkFamilies("list/own_cells.frag",
                                    {{{{"HS_CELLS 16"}}}, {{{"HS_WHOLE_LIGHT"}}}, flag("HS_SUM_CASTERS")})});
}

}  // namespace halfshadow::techniques
