// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// All shader variants that may be asked for.
#pragma once

#include "gl/program.hpp"

namespace halfshadow::techniques {

std::vector<gl::AllowedVariants> shaderTable();

}  // namespace halfshadow::techniques
