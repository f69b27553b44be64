// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Penumbra wedges blended as Forest, Barthe and Paulin do: per quadrant of the light the share, rectangle
/// and centre of gravity of what each caster occludes, combined caster by caster.
#pragma once

#include <memory>

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makeWedgesBlended();

}  // namespace halfshadow::techniques
