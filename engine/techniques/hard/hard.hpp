// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Hard shadow maps (Williams 1978; Evans 2014, 3.1).
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makeHard();

}  // namespace halfshadow::techniques
