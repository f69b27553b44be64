// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Penumbrae from silhouettes with light cells: four sub-lights with silhouettes of their own, coverage of
/// each cell exact per caster, product over casters. Gathered per receiver fragment from vertex lists per
/// tile, or scattered caster by caster into targets.
#pragma once

#include <memory>

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makeWedgesCells();

}  // namespace halfshadow::techniques
