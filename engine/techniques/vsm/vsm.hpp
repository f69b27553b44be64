// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Variance shadow maps (Donnelly and Lauritzen 2006; Evans 2014, 3.2 and 4.2).
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makeVsm();

}  // namespace halfshadow::techniques
