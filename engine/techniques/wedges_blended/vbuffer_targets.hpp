// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Forest's vBuffer in RGBA8 targets, each caster merged into it where it stands: the share of each quadrant
/// of the light that is occluded, four rectangles, and on demand centres of gravity.
#pragma once

#include "techniques/parts/caster_volumes/caster_draws.hpp"

namespace halfshadow::techniques {

/// How the rectangles of casters are united.
enum class SideMerge {
  core,    ///< what a caster's sides exceed those before by goes to a target of its own, then is added
  minmax,  ///< the larger by blending: EXT_blend_minmax
  fetch    ///< the larger by the shader, which reads the pixel it writes
};

struct VbufferRequest {
  SideMerge merge = SideMerge::core;
  bool centres = false;  ///< of gravity
};

/// Casters that cannot meet are merged together, a batch in one draw a target. Makes the plan's shading.
/// Based on: Forest, Barthe, Paulin 2006, section 4. Errors: outOfMemory.
Status planVbufferTargets(const LightScene& scene, PassPlan& plan, LightLoops& loops, CasterDraws& draws,
                          const VbufferRequest& request);

}  // namespace halfshadow::techniques
