// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Percentage closer soft shadows with a two-fetch blocker search.
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makePcssMip();

}  // namespace halfshadow::techniques
