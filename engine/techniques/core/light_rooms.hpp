// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Closed casters around the light. Outside of them all is dark; what stands inside is lit, unless other
/// walls of the same room come between. The camera is on one side, and sees only what is on the same side.
/// CPU only.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outlines/caster_loops.hpp"
#include "techniques/core/light_scene.hpp"

namespace halfshadow::techniques {

/// Closed parts inside which something may be seen: not those that are drawn and have the near plane of the
/// view outside.
std::vector<outlines::RoomPart> partsSeenInside(const LightScene& scene);

/// Whether one of them holds the light's centre: silhouettes do not tell what it hides from what stands
/// inside.
bool lightIsInRoom(const LightScene& scene);

/// For techniques of silhouettes alone.
std::optional<StandIn> standInForRooms(const LightScene& scene);

}  // namespace halfshadow::techniques
