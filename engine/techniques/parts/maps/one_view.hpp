// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Where one map seen from the light's centre cannot tell the shadows of the whole light.
#pragma once

#include <optional>

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

/// `sampled`, with the reason, when a caster comes nearer to the light than the light is wide: it hides other
/// things from every point of the light, and its penumbra is as wide as the map. A post beside the lamp, a
/// shade around it, a caster that the light touches or lies in. So when one is nearer than the map begins.
/// For techniques that see all casters from the light's centre and search penumbrae in that view.
std::optional<StandIn> standInForOneView(const LightScene& scene);

}  // namespace halfshadow::techniques
