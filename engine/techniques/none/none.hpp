// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// No shadows: visibility 1 everywhere; the cost that every other technique is compared with.
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makeNone();

}  // namespace halfshadow::techniques
