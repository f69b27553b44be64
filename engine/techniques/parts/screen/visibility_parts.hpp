// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Visibility in parts, where a program that finds all of it has no room on a device.
#pragma once

#include <vector>

#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

/// One a channel of the image that they are left in.
inline constexpr std::size_t kMostVisibilityParts = 4;

/// Sets the plan's shading to one that reads from the screen what `parts`, drawn one after the other, leave
/// there: each is 1 less what it finds hidden of the light, and what they find adds up. At most
/// kMostVisibilityParts.
void planVisibilityParts(const LightScene& scene, PassPlan& plan, std::vector<ReceiverShading> parts);

}  // namespace halfshadow::techniques
