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

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

/// A closed part of a caster.
struct RoomPart {
  std::uint32_t object = 0;  ///< in placedCasters()
  std::uint32_t part = 0;
  bool operator==(const RoomPart&) const = default;
};

/// Closed parts inside which something may be seen: not those that are drawn and have the near plane of the
/// view outside.
std::vector<RoomPart> partsSeenInside(const LightFrame& frame);

/// Whether one of them holds the light's centre: silhouettes do not tell what it hides from what stands
/// inside.
bool lightIsInRoom(const LightFrame& frame);

/// For techniques of silhouettes alone.
std::optional<StandIn> standInForRooms(const LightFrame& frame);

}  // namespace halfshadow::techniques
