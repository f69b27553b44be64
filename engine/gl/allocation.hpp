// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Errors of making an object, said alike for all kinds. Internal to the object sources.
#pragma once

#include <string>

#include "gl/context.hpp"

namespace halfshadow::gl {

std::string sizeText(int width, int height);
/// What glGetError says about the storage just asked for; errors of earlier calls are collected before it.
/// Errors: outOfMemory, capabilityMissing.
Status allocationStatus(Context& context, const std::string& what);
/// The driver gave no name for it.
Error noNameError(const Context& context, const std::string& what);

}  // namespace halfshadow::gl
