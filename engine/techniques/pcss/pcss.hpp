// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Percentage closer soft shadows (Fernando 2005; Evans 2014, 3.2).
#pragma once

#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

std::unique_ptr<Technique> makePcss();

}  // namespace halfshadow::techniques
