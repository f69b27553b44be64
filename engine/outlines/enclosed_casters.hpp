// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Casters inside another one: they hide nothing that it does not hide. CPU only.
#pragma once

#include <span>
#include <vector>

#include "scene/light.hpp"
#include "scene/light_silhouettes.hpp"

namespace halfshadow::outlines {

/// For each caster, whether it lies inside a closed convex one that has all of the light outside: receivers
/// within that one are dark, and for those beyond it nothing inside adds to its shadow. Conservative.
std::vector<bool> enclosedCasters(std::span<const scene::PlacedCaster> casters,
                                  const scene::AreaLight& light);

}  // namespace halfshadow::outlines
