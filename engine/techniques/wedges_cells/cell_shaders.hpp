// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variants of the shaders of light cells.
#pragma once

#include "techniques/parts/lists/list_shaders.hpp"
#include "techniques/parts/screen/screen_shaders.hpp"

namespace halfshadow::techniques {

inline std::vector<ShaderFamily> cellShaders() {
  const ShaderAxis cells = values("HS_CELLS", {4, 16, 32});
  return joined({{receiverDepthShader(),
                  {"list/caster_volume.vert",
                   "list/caster_cells.frag",
                   {cells, flag("HS_UPPER_CELLS", {"HS_CELLS 32"}), flag("HS_USE_FETCH"), castingAxis(),
                    flag("HS_SIDES", {"HS_CASTING_RECEIVER"})}},
                  fullscreen("list/cell_mean.frag")},
                 listReceiverFamilies("list/screen_cells.frag", ListedIn::castingReceivers,
                                      {{{{"HS_CELL_TARGETS 1", "HS_CELLS 4"}},
                                        {{"HS_CELL_TARGETS 4", "HS_CELLS 16"}},
                                        {{"HS_CELL_TARGETS 1", "HS_CELLS 32"}}}}),
                 listReceiverFamilies("list/wedges_cells.frag", ListedIn::always, {cells}),
                 screenWalkFamilies("list/own_cells.frag", {cells})});
}

}  // namespace halfshadow::techniques
