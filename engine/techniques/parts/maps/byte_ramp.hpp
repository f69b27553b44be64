// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A depth's two bytes by look-up, for fragment shaders without highp.
#pragma once

#include <cstdint>

#include "techniques/core/pass_plan.hpp"

namespace halfshadow::techniques {

/// 512 x 256 texels that turn (d, 256·d) into the two bytes of d; index in the plan's textures, once a plan.
std::uint32_t addByteRamp(PassPlan& plan);

}  // namespace halfshadow::techniques
