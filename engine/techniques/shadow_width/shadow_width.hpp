// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Shadow-width maps (Kirsch and Döllner 2003), and their two-sided form with widths from the light's size.
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makeShadowWidth();

}  // namespace halfshadow::techniques
