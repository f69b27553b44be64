// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Light cells in RGBA8 targets: what each caster leaves of a cell is multiplied into it where it stands.
#pragma once

#include "techniques/parts/caster_volumes/caster_draws.hpp"

namespace halfshadow::techniques {

/// How a caster's cells are multiplied into a target.
enum class CellProduct {
  blended,  ///< by fixed-function blending (ZERO, SRC_COLOR)
  fetched   ///< by the shader, which reads the pixel it writes: rounded to nearest on every device
};

/// One pass a target: four sub-lights of one cell in one target, of four cells in four, of eight in eight
/// (and one that takes their mean).
/// `cells`: 4, 16 or 32. Makes the plan's shading. Errors: outOfMemory.
Status planCellTargets(const LightScene& scene, PassPlan& plan, LightLoops& loops, CasterDraws& draws,
                       int cells, CellProduct product);

}  // namespace halfshadow::techniques
