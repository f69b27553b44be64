// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Surfaces that cast although nothing lies behind them: grounds and walls. To techniques that see one layer
/// of casters they fill the map, and hide the silhouettes before them.
#pragma once

#include <cstdint>
#include <vector>

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

/// Receivers as a pass draws them that asks what lies last along a ray from the light. Where a caster is also
/// the last receiver, it shadows nothing.
struct LastReceivers {
  std::vector<DrawItem> drawn;
  /// Casters that count as infinitely far wherever they are: what they are before is always shadowed, and
  /// they themselves cast, also past the border of the ground below them.
  std::vector<DrawItem> infinite;
  std::uint64_t contentKey = 0;  ///< of the light and all receivers listed
  /// No caster can be the last receiver of others' shadows; a pass would change nothing.
  bool empty = true;
};

/// The projection with everything behind everything else, but not beyond the far plane by rounding: for
/// LastReceivers::infinite.
glm::dmat4 almostInfinitelyFar(const glm::dmat4& clipFromWorld);

/// A caster that receives is drawn as it lies when it is an open surface, or when another caster in front of
/// it is seen, from the light's centre, inside its box.
LastReceivers lastReceivers(const LightScene& scene);

}  // namespace halfshadow::techniques
