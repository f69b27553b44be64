// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// N hard shadows averaged on the GPU.
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makeSampled();

}  // namespace halfshadow::techniques
